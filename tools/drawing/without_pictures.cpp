// In place of FreeType and cairo, in a program without pictures.

#include "morsel/tools/drawing/lettering.h"
#include "morsel/tools/drawing/pictures.h"

namespace morsel::tools::drawing {

bool has_pictures() { return false; }

Lettering::Lettering() : surface_(nullptr), context_(nullptr) { require_pictures("lettering"); }
Lettering::~Lettering() = default;
double Lettering::width(std::string_view, double) { return 0; }
std::string Lettering::shortened(std::string_view, double, double) { return {}; }
void Lettering::use(cairo_t*, double) {}

void check_text(std::string_view) { require_pictures("lettering"); }

}  // namespace morsel::tools::drawing
