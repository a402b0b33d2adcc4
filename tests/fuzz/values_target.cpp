#include <algorithm>
#include <sstream>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/text/parameters.h"
#include "morsel/morse/functions/value_file.h"
#include "number.h"
#include "target.h"

void morsel::fuzz::values(std::string_view bytes) {
  try {
    std::istringstream stream{std::string(bytes)};
    const morse::ValueFile file(stream, "fuzz", {});
    std::string text;
    const auto lines = static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n')) + 1;
    for (std::size_t i = 0; i < file.values().size(); ++i) {
      const std::string place = file.place(i);
      require(place.starts_with("line "), "a place is a line");
      const auto line = static_cast<std::size_t>(core::parse_integer(place.substr(5), "line"));
      require(line > i && line <= lines, "the line of a value");
      text += core::shortest(file.values()[i]) + "\n";
    }
    std::istringstream written(text);
    const morse::ValueFile again(written, "written", {});
    require(std::equal(file.values().begin(), file.values().end(), again.values().begin(),
                       again.values().end(), same_number),
            "written and read again");
  } catch (const core::BadInput&) {
  }
}
