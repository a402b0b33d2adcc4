// Values and labels of FreeSurfer, as nibabel reads them.

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "morsel/core/io/big_endian.h"
#include "morsel/core/io/brain_values.h"
#include "morsel/core/io/freesurfer.h"
#include "morsel/core/text/text_scanner.h"

namespace morsel::core {
namespace freesurfer {
namespace {

constexpr std::size_t kValuesBetweenPauses = 1 << 16;  // values between two looks at whether to stop

std::string entry_place(std::size_t i) { return "entry " + std::to_string(i); }

class AnnotationReader {
 public:
  AnnotationReader(std::string_view bytes, const ValueRequest& request) : reader_(bytes), request_(request) {}

  ValueFile read() {
    const std::uint32_t count = counted(8, "vertices");
    struct Labelled {
      std::uint32_t vertex;
      std::uint32_t color;
    };
    std::vector<Labelled> labelled(count);
    for (std::size_t i = 0; i < count; ++i) {
      pause(i);
      labelled[i] = {reader_.unsigned32(), reader_.unsigned32()};
      if (labelled[i].vertex >= count)
        fail("entry " + std::to_string(i) + " is of vertex " + std::to_string(labelled[i].vertex) +
             ", but there are " + std::to_string(count));
    }
    if (reader_.remaining() < 4 || reader_.signed32() == 0)
      fail("it has no colour table, which would say what its labels are");
    read_table();
    ValueFile result{std::vector<double>(count, -1), entry_place};
    for (const Labelled& one : labelled) {
      const auto known = number_.find(one.color);
      result.values[one.vertex] = one.color == 0 || known == number_.end() ? -1.0 : known->second;
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { fail_reading(request_.file, what); }
  [[noreturn]] void fail_short() const { fail("it ends within its colour table"); }

  void pause(std::size_t i) const {
    if ((i + 1) % kValuesBetweenPauses == 0) request_.progress.throw_if_cancelled();
  }

  /// A count of things that take at least so many bytes each.
  std::uint32_t counted(std::size_t size, const std::string& what) {
    if (reader_.remaining() < 4) fail("it ends before the number of " + what);
    const std::int32_t count = reader_.signed32();
    if (count < 0 || static_cast<std::uint64_t>(count) * size > reader_.remaining())
      fail("it announces " + std::to_string(count) + " " + what + ", for which " +
           std::to_string(reader_.remaining()) + " bytes are left");
    return static_cast<std::uint32_t>(count);
  }

  /// A text with its length before it, which says nothing here.
  void skip_text() { reader_.bytes(counted(1, "letters of a name")); }

  /// Red, green, blue and transparency, of which the first three identify a label.
  void read_color(std::uint32_t number) {
    if (reader_.remaining() < 16) fail_short();
    std::uint32_t color = 0;
    for (const int shift : {0, 8, 16}) color |= (reader_.unsigned32() & 0xFF) << shift;
    reader_.unsigned32();
    number_.emplace(color, number);  // the first of several with a colour
  }

  void read_table() {
    constexpr std::size_t kLeast = 16 + 4;  // a colour and the length of a name
    if (reader_.remaining() < 4) fail_short();
    const std::int32_t first = reader_.signed32();
    if (first > 0) {  // the old kind, which begins with the number of its entries
      if (static_cast<std::uint64_t>(first) * kLeast > reader_.remaining()) fail_short();
      skip_text();
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(first); ++i) {
        skip_text();
        read_color(i);
      }
      return;
    }
    if (first != -2) fail("its colour table has the unknown version " + std::to_string(-std::int64_t{first}));
    if (reader_.remaining() < 4) fail_short();
    reader_.signed32();  // one more than the largest number of an entry
    skip_text();         // where the table came from
    const std::uint32_t entries = counted(kLeast + 4, "entries of its colour table");
    for (std::uint32_t i = 0; i < entries; ++i) {
      if (reader_.remaining() < 4) fail_short();
      const std::int32_t number = reader_.signed32();
      if (number < 0) fail("an entry of its colour table has the number " + std::to_string(number));
      skip_text();
      read_color(static_cast<std::uint32_t>(number));
    }
  }

  BigEndianReader reader_;
  const ValueRequest& request_;
  std::unordered_map<std::uint32_t, std::uint32_t> number_;  // of a label, by its colour
};

void refuse_other_columns(const ValueRequest& request) {
  if (!request.column.empty()) static_cast<void>(numbered_column(request, 1, "it"));
}

}  // namespace
}  // namespace freesurfer

ValueFile read_freesurfer_values(std::string_view bytes, const ValueRequest& request) {
  using namespace freesurfer;
  refuse_other_columns(request);
  BigEndianReader reader(bytes);
  const auto check_size = [&](std::uint64_t count, std::uint64_t header, std::uint64_t size) {
    if (bytes.size() != header + count * size)
      fail_reading(request.file, "it announces " + std::to_string(count) +
                                     " values, which with its header take " +
                                     std::to_string(header + count * size) + " bytes, but it has " +
                                     std::to_string(bytes.size()));
  };
  ValueFile result{{}, entry_place};
  if (bytes.size() < 6) fail_reading(request.file, "it is too short for FreeSurfer's values");
  const std::uint32_t first = reader.unsigned24();
  if (first == static_cast<std::uint32_t>(FreeSurferMagic::quads)) {
    if (reader.remaining() < 12) fail_reading(request.file, "it ends within its header");
    const std::uint32_t count = reader.unsigned32();
    reader.unsigned32();  // faces
    const std::int32_t columns = reader.signed32();
    if (columns != 1)
      fail_reading(request.file,
                   "it announces " + std::to_string(columns) + " values for each vertex, not one");
    check_size(count, 15, 4);
    result.values.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      if ((i + 1) % kValuesBetweenPauses == 0) request.progress.throw_if_cancelled();
      result.values[i] = reader.float32();
    }
    return result;
  }
  reader.unsigned24();  // faces
  check_size(first, 6, 2);
  result.values.resize(first);
  for (double& value : result.values) value = reader.signed16() / 100.0;
  return result;
}

ValueFile read_annotation_values(std::string_view bytes, const ValueRequest& request) {
  if (bytes.empty()) fail_reading(request.file, "it is empty");
  freesurfer::refuse_other_columns(request);
  return freesurfer::AnnotationReader(bytes, request).read();
}

}  // namespace morsel::core
