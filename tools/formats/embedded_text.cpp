#include "morsel/tools/formats/embedded_text.h"

namespace morsel::tools {

std::string joined(EmbeddedText text) {
  std::string whole;
  for (const std::string_view piece : text) whole += piece;
  return whole;
}

}  // namespace morsel::tools
