#include "version.h"

namespace carom {

const char* const program_version = CAROM_VERSION;
const char* const program_and_version = "carom " CAROM_VERSION;

}  // namespace carom
