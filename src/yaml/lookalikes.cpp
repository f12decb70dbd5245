#include "yaml/lookalikes.h"

#include <fmt/format.h>

#include "std.h"
#include "yaml/letters.h"

namespace carom {
namespace {

constexpr string_view hyphen = "`-`", space = "a plain space", nothing = "nothing there", quote = "`'`";

constexpr Lookalike all_lookalikes[] = {
    {0x2212, "a minus sign", hyphen},
    {0x2013, "an en dash", hyphen},
    {0x2014, "an em dash", hyphen},
    {0x2010, "a typographic hyphen", hyphen},
    {0x2011, "a no-break hyphen", hyphen},
    {0x2012, "a figure dash", hyphen},
    {0x2015, "a horizontal bar", hyphen},
    {0xFE63, "a small hyphen", hyphen},
    {0xFF0D, "a full-width hyphen", hyphen},
    {0x00A0, "a no-break space", space},
    {0x202F, "a narrow no-break space", space},
    {0x2002, "an en space", space},
    {0x2003, "an em space", space},
    {0x2007, "a figure space", space},
    {0x2008, "a punctuation space", space},
    {0x2009, "a thin space", space},
    {0x200A, "a hair space", space},
    {0x205F, "a mathematical space", space},
    {0x3000, "an ideographic space", space},
    {0x200B, "a zero-width space", nothing},
    {0x00AD, "a soft hyphen, which is not seen", nothing},
    {0x2060, "a word joiner, which is not seen", nothing},
    {0x2018, "a curly quote", quote},
    {0x2019, "a curly quote", quote},
    {0x201A, "a low quote", quote},
    {0x201C, "a curly quote", quote},
    {0x201D, "a curly quote", quote},
    {0x201E, "a low quote", quote},
    {0x00D7, "a multiplication sign", "`*`"},
    {0x00B7, "a middle dot", "`*`"},
    {0x22C5, "a dot operator", "`*`"},
    {0x00F7, "a division sign", "`/`"},
    {0xFF1A, "a full-width colon", "`: `"},
    {0xFF0C, "a full-width comma", "`, `"},
};

}  // namespace

optional<Lookalike> lookalike_at(string_view text, size_t i) {
  char32_t code = 0;
  if (i >= text.size() || utf8_length(text, i, code) < 2) return nullopt;
  const Lookalike* const found = std::find_if(std::begin(all_lookalikes), std::end(all_lookalikes),
                                              [&](const Lookalike& l) { return l.code == code; });
  return found == std::end(all_lookalikes) ? nullopt : optional(*found);
}

bool is_blank(const Lookalike& lookalike) {
  return lookalike.plain == space || lookalike.plain == nothing;
}

string lookalike_in(string_view text) {
  for (size_t i = 0; i < text.size(); ++i)
    if (const optional<Lookalike> found = lookalike_at(text, i))
      return fmt::format("U+{:04X} is {}: write {}", uint32_t(found->code), found->name, found->plain);
  return {};
}

}  // namespace carom
