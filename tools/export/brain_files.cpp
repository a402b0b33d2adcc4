#include "morsel/tools/export/brain_files.h"

#include <bit>
#include <cstddef>
#include <unordered_map>
#include <unordered_set>

#include "morsel/core/error.h"
#include "morsel/core/io/file_writer.h"
#include "morsel/core/text/numbers.h"
#include "morsel/tools/formats/base64.h"
#include "morsel/tools/formats/markup.h"

namespace morsel::tools {
namespace {

using Rgb = std::array<std::uint8_t, 3>;

constexpr std::uint32_t kColorTableTag = 1;
constexpr std::uint32_t kCommandLineTag = 3;

/// Appends numbers, the byte of most weight first.
class BigEndianText {
 public:
  void add(std::uint32_t value) {
    for (const int shift : {24, 16, 8, 0}) bytes_ += static_cast<char>(value >> shift & 0xFF);
  }
  void add(std::int32_t value) { add(static_cast<std::uint32_t>(value)); }
  /// A text that ends with 0, after its length.
  void add(const std::string& text) {
    add(static_cast<std::uint32_t>(text.size() + 1));
    bytes_.append(text).push_back('\0');
  }
  void add_raw(std::string_view bytes) { bytes_ += bytes; }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// How an annotation writes a colour, by which it identifies a label.
std::uint32_t annotation_of(const Rgb& color) {
  return color[0] | std::uint32_t{color[1]} << 8 | std::uint32_t{color[2]} << 16;
}

std::string label_name(const BrainLabels& labels, std::size_t i) {
  return labels.name + "_" + std::to_string(i);
}

/// Numbers of 32 bits as GIFTI has them in base64.
template <class Number, class Value>
std::string encoded(std::span<const Value> values) {
  std::string bytes;
  bytes.reserve(4 * values.size());
  for (const Value value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<Number>(value));
    for (const int shift : {0, 8, 16, 24}) bytes += static_cast<char>(bits >> shift & 0xFF);
  }
  return base64(bytes);
}

std::string metadata(const std::string& name, const std::string& value) {
  return "<MetaData><MD><Name>" + name + "</Name><Value>" + value + "</Value></MD></MetaData>\n";
}

/// `table` is the element LabelTable.
void write_gifti(const core::FileTarget& target, const std::string& intent, const std::string& type,
                 const std::string& name, std::size_t count, const std::string& data,
                 const std::string& table, const Provenance& provenance) {
  core::FileWriter file(target);
  file.write(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!DOCTYPE GIFTI SYSTEM \"http://gifti.projects.nitrc.org/gifti.dtd\">\n"
      "<GIFTI Version=\"1.0\" NumberOfDataArrays=\"1\">\n");
  file.write(metadata("provenance", provenance.json()));
  file.write(table);
  file.write("<DataArray Intent=\"" + intent + "\" DataType=\"" + type +
             "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"1\" Dim0=\"" + std::to_string(count) +
             "\" Encoding=\"Base64Binary\" Endian=\"LittleEndian\" ExternalFileName=\"\" "
             "ExternalFileOffset=\"0\">\n");
  file.write(metadata("Name", markup_text(name)));
  file.write("<Data>");
  file.write(data);
  file.write("</Data>\n</DataArray>\n</GIFTI>\n");
  file.commit();
}

}  // namespace

std::vector<Rgb> distinct_colors(std::span<const Rgb> colors) {
  constexpr std::size_t kColors = (std::size_t{1} << 24) - 1;
  if (colors.size() > kColors)
    throw core::InvalidArgument("an annotation has at most " + core::grouped(kColors) +
                                " labels, as each has a colour of its own; there are " +
                                core::grouped(colors.size()));
  std::vector<Rgb> distinct;
  distinct.reserve(colors.size());
  std::unordered_set<std::uint32_t> used = {0};  // which stands for no label
  std::unordered_map<std::uint32_t, std::uint32_t> changes;
  for (const Rgb& color : colors) {
    std::uint32_t& change = changes[annotation_of(color)];
    Rgb candidate = color;
    // Bits 0, 3, 6, … of the change are of red, the next ones of green and of blue: each change gives another
    // colour, the first ones close to the one wanted.
    while (!used.insert(annotation_of(candidate)).second) {
      ++change;
      candidate = color;
      for (int bit = 0; bit < 24; ++bit)
        candidate[bit % 3] = static_cast<std::uint8_t>(candidate[bit % 3] ^ ((change >> bit & 1) << bit / 3));
    }
    distinct.push_back(candidate);
  }
  return distinct;
}

void write_annotation(const core::FileTarget& target, const BrainLabels& labels,
                      const Provenance& provenance) {
  const std::vector<Rgb> colors = distinct_colors(labels.colors);
  BigEndianText text;
  text.add(static_cast<std::uint32_t>(labels.of_vertex.size()));
  for (std::size_t v = 0; v < labels.of_vertex.size(); ++v) {
    const std::int32_t label = labels.of_vertex[v];
    text.add(static_cast<std::uint32_t>(v));
    text.add(label < 0 ? 0 : annotation_of(colors[static_cast<std::size_t>(label)]));
  }
  text.add(kColorTableTag);
  text.add(std::int32_t{-2});  // the version of the table
  text.add(static_cast<std::uint32_t>(colors.size()));
  text.add("NOFILE");
  text.add(static_cast<std::uint32_t>(colors.size()));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    text.add(static_cast<std::uint32_t>(i));
    text.add(label_name(labels, i));
    for (const std::uint8_t channel : colors[i]) text.add(std::uint32_t{channel});
    text.add(std::uint32_t{0});  // transparency
  }
  // Readers stop behind the table, or go on by tags, each with a length of 64 bits.
  const std::string origin = provenance.json();
  text.add(kCommandLineTag);
  text.add(std::uint32_t{0});
  text.add(static_cast<std::uint32_t>(origin.size()));
  text.add_raw(origin);
  core::write_file(target, text.bytes());
}

void write_gifti_labels(const core::FileTarget& target, const BrainLabels& labels,
                        const Provenance& provenance) {
  std::string table =
      "<LabelTable>\n<Label Key=\"-1\" Red=\"1\" Green=\"1\" Blue=\"1\" Alpha=\"0\">???"
      "</Label>\n";
  for (std::size_t i = 0; i < labels.colors.size(); ++i) {
    const auto channel = [&](int c) { return core::to_decimals(labels.colors[i][c] / 255.0, 6); };
    table += "<Label Key=\"" + std::to_string(i) + "\" Red=\"" + channel(0) + "\" Green=\"" + channel(1) +
             "\" Blue=\"" + channel(2) + "\" Alpha=\"1\">" + markup_text(label_name(labels, i)) +
             "</Label>\n";
  }
  table += "</LabelTable>\n";
  write_gifti(target, "NIFTI_INTENT_LABEL", "NIFTI_TYPE_INT32", labels.name, labels.of_vertex.size(),
              encoded<std::int32_t>(labels.of_vertex), table, provenance);
}

void write_gifti_values(const core::FileTarget& target, std::span<const double> values,
                        const std::string& intent, const std::string& name, const Provenance& provenance) {
  write_gifti(target, intent, "NIFTI_TYPE_FLOAT32", name, values.size(), encoded<float>(values),
              "<LabelTable/>\n", provenance);
}

}  // namespace morsel::tools
