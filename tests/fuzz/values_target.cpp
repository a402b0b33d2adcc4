#include <algorithm>
#include <string>

#include "morsel/core/error.h"
#include "morsel/core/io/value_file.h"
#include "morsel/core/text/parameters.h"
#include "number.h"
#include "target.h"

namespace morsel::fuzz {
namespace {

/// The values of one kind, told by the name, written as a text are the same values.
void check_values(std::string_view bytes, const std::string& name, const std::string& column) {
  try {
    const core::ValueFile file = core::parse_value_file(bytes, name, column);
    std::string text;
    const auto lines = static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), '\n') +
                                                std::count(bytes.begin(), bytes.end(), '\r')) +
                       1;
    std::size_t last = 0;
    for (std::size_t i = 0; i < file.values.size(); ++i) {
      const std::string place = file.place(i);
      if (place.starts_with("line ")) {
        const auto line = static_cast<std::size_t>(core::parse_integer(place.substr(5), "line"));
        require(line > last && line <= lines, "the line of a value");
        last = line;
      } else {
        require(place == "entry " + std::to_string(i), "a place is a line or an entry");
      }
      text += core::shortest(file.values[i]) + "\n";
    }
    const core::ValueFile again = core::parse_value_file(text, "written.txt");
    require(again.warnings.empty(), "nothing is odd in what was written");
    require(std::equal(file.values.begin(), file.values.end(), again.values.begin(), again.values.end(),
                       same_number),
            "written and read again");
  } catch (const core::BadInput& error) {
    require(std::string(error.what()).find("fuzz") != std::string::npos, "an error names the file");
  }
}

}  // namespace

void values(std::string_view bytes) {
  for (const char* name : {"fuzz.txt", "fuzz.csv", "fuzz.npy", "fuzz.annot", "fuzz.gii"})
    for (const char* column : {"", "2", "value"}) check_values(bytes, name, column);
}

}  // namespace morsel::fuzz
