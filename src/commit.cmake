# Writes the source SOURCE that has the commit of the tree ROOT, where it is not what it was. Run at every build.
set(archived [[$Format:%H$]])  # by git archive, see .gitattributes
set(commit "")
if(EXISTS ${ROOT}/.git)
  # Without git, or where git does not trust the owner of the tree, there is no commit.
  execute_process(COMMAND git -C ${ROOT} rev-parse --verify HEAD OUTPUT_VARIABLE commit ERROR_QUIET)
elseif(archived MATCHES "^[0-9a-f]+$")
  set(commit ${archived})
endif()
# As many digits in each clone; git's own number grows with its objects.
string(SUBSTRING "${commit}" 0 10 commit)
if(commit AND EXISTS ${ROOT}/.git)
  # No locks: this is no reason to write the index.
  execute_process(COMMAND git --no-optional-locks -C ${ROOT} status --porcelain -- CMakeLists.txt src ":(exclude)*.md"
    OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    string(APPEND commit ", sources changed")
  endif()
endif()
file(CONFIGURE OUTPUT ${SOURCE} @ONLY CONTENT [[
#include "commands/program.h"

const char* const carom::program_commit = "@commit@";
]])
