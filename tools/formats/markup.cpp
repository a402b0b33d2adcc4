#include "morsel/tools/formats/markup.h"

#include "morsel/core/text/printable.h"

namespace morsel::tools {

std::string markup_text(std::string_view text) {
  std::string safe;
  safe.reserve(text.size());
  for (const char c : core::printable(text, "\n\t")) switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  return safe;
}

}  // namespace morsel::tools
