#include "morsel/core/io/file_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "morsel/core/text/ascii_case.h"

namespace morsel::core {
namespace {

using namespace std::string_view_literals;

struct Mark {
  std::string_view bytes;
  std::string_view kind;
  std::size_t at = 0;  ///< where in the file
};

/// Bytes that say what a file is.
constexpr auto kMarks = std::to_array<Mark>({{"\x1F\x8B"sv, "gzip data"},
                                             {"\xFD"
                                              "7zXZ\0"sv,
                                              "xz data"},
                                             {"\x28\xB5\x2F\xFD"sv, "zstd data"},
                                             {"BZh"sv, "bzip2 data"},
                                             {"\x04\x22\x4D\x18"sv, "lz4 data"},
                                             {"PK\x03\x04"sv, "a ZIP archive"},
                                             {"PK\x05\x06"sv, "an empty ZIP archive"},
                                             {"7z\xBC\xAF\x27\x1C"sv, "a 7-Zip archive"},
                                             {"Rar!\x1A\x07"sv, "a RAR archive"},
                                             {"ustar"sv, "a tar archive", 257},
                                             {"%PDF-"sv, "a PDF document"},
                                             {"%!PS"sv, "a PostScript document"},
                                             {"\x89PNG\r\n\x1A\n"sv, "a PNG picture"},
                                             {"\xFF\xD8\xFF"sv, "a JPEG picture"},
                                             {"GIF87a"sv, "a GIF picture"},
                                             {"GIF89a"sv, "a GIF picture"},
                                             {"II*\0"sv, "a TIFF picture"},
                                             {"MM\0*"sv, "a TIFF picture"},
                                             {"\x7F"
                                              "ELF"sv,
                                              "a program"},
                                             {"\x89HDF\r\n\x1A\n"sv, "an HDF5 file"},
                                             {"\x93NUMPY"sv, "a numpy array"},
                                             {"SQLite format 3\0"sv, "an SQLite database"},
                                             {"glTF"sv, "a glTF file"},
                                             {"\xFF\xFF\xFE"sv, "a FreeSurfer surface"},
                                             {"\xFF\xFF\xFF"sv, "a FreeSurfer overlay"},
                                             {"BLENDER"sv, "a Blender scene"},
                                             {"Kaydara FBX Binary"sv, "an FBX file"},
                                             {"# vtk DataFile"sv, "a legacy VTK file"},
                                             {"#VRML"sv, "a VRML file"},
                                             {"version https://git-lfs"sv, "a Git LFS pointer, not the file"},
                                             {"ISO-10303-21"sv, "a STEP file"},
                                             {"\xFF\xFE"sv, "UTF-16 text"},
                                             {"\xFE\xFF"sv, "UTF-16 text"}});

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

bool is_numeral(std::string_view word) {
  return !word.empty() && word.find_first_not_of("+-.0123456789eE") == std::string_view::npos &&
         word.find_first_of("0123456789") != std::string_view::npos;
}

/// The next word of a text, which it is removed from; empty at the end of its line.
std::string_view next_word(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
  text.remove_prefix(word.size());
  return word;
}

/// What of XML begins with `<`.
std::string_view markup_kind(std::string_view text) {
  struct Root {
    std::string_view name, kind;
  };
  constexpr auto kRoots = std::to_array<Root>({{"<!doctype html", "an HTML page"},
                                               {"<html", "an HTML page"},
                                               {"<vtkfile", "a VTK XML file"},
                                               {"<gifti", "a GIFTI file"},
                                               {"<svg", "an SVG picture"},
                                               {"<collada", "a COLLADA file"},
                                               {"<x3d", "an X3D file"}});
  for (std::size_t at = 0; at != std::string_view::npos; at = text.find('<', at + 1))
    for (const Root& root : kRoots)
      if (begins_with_keyword(text.substr(at), root.name)) return root.kind;
  return "XML";
}

/// What a text is by its first line with a word that is no comment.
std::string_view text_kind(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  if (text.starts_with('<')) return markup_kind(text);
  if (text.starts_with('{') || text.starts_with('[')) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", 1);
    return next != std::string_view::npos && "\"{}[]-0123456789"sv.find(text[next]) != std::string_view::npos
               ? "JSON"
               : "";
  }
  while (text.starts_with('#')) {
    text.remove_prefix(std::min(text.find_first_of("\r\n"), text.size()));
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  }
  std::string_view rest = text;
  const std::string_view first = next_word(rest);
  const std::string_view second = next_word(rest);
  if (first == "ply" && second.empty()) return "a PLY file";
  if (first.ends_with("OFF") && first.size() < 10 && (second.empty() || is_numeral(second)))
    return "an OFF file";
  if (is_one_of(first, {"v", "vt", "vn"}) && is_numeral(second)) return "an OBJ file";
  if (is_one_of(first, {"mtllib", "usemtl", "o", "g"}) && !second.empty()) return "an OBJ file";
  if (begins_with_keyword(first, "solid") && first.size() == 5) {
    rest.remove_prefix(std::min(rest.find_first_of("\r\n"), rest.size()));
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
    if (begins_with_keyword(rest, "facet") || begins_with_keyword(rest, "endsolid"))
      return "an ASCII STL file";
  }
  if (first.starts_with("data_") && first.size() > 5) return "a CIF file";
  if (is_one_of(first, {"HEADER", "ATOM", "HETATM", "CRYST1", "REMARK", "MODEL"}) && !second.empty())
    return "a PDB file";
  if (is_one_of(first, {"ncols", "NCOLS"}) && is_numeral(second)) return "an ESRI ASCII grid";
  return "";
}

/// Every second byte of a text in Latin letters is 0.
bool is_unmarked_utf16(std::string_view bytes) {
  if (bytes.size() < 8) return false;
  for (const std::size_t zero : {std::size_t{0}, std::size_t{1}}) {
    bool all = true;
    for (std::size_t i = 0; all && i < 8; i += 2)
      all = bytes[i + zero] == '\0' && bytes[i + 1 - zero] >= '\t' && bytes[i + 1 - zero] <= '~';
    if (all) return true;
  }
  return false;
}

}  // namespace

std::string_view file_kind(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);  // a byte-order mark
  for (const Mark& mark : kMarks)
    if (bytes.size() >= mark.at && bytes.substr(mark.at).starts_with(mark.bytes)) return mark.kind;
  if (is_unmarked_utf16(bytes)) return "UTF-16 text without a byte-order mark";
  bytes = bytes.substr(0, 4096);
  return text_kind(bytes);
}

}  // namespace morsel::core
