#pragma once
/// Texts of unknown origin made safe for a terminal and for messages of one line.

#include <string>
#include <string_view>

namespace morsel::core {

/// The text with everything escaped that a terminal would not just show as a character: control
/// characters (C0, DEL, C1), line and paragraph separators and what changes the direction of writing (\n, \t,
/// \r, \x1b, \u0085, \u202e), noncharacters that XML forbids, and bytes that are not UTF-8 (\xff). All else
/// stays, backslashes too, so the result cannot be parsed back. Control characters in `but` stay as well.
std::string printable(std::string_view text, std::string_view but = {});

/// JSON text, or a part of a JSON string, with the characters that printable() escapes as \u009b, which is
/// the same string for a parser. Bytes that are not UTF-8, which JSON cannot escape, stay, and so do control
/// characters in `but`. Copies ASCII text without control characters at once.
std::string json_printable(std::string text, std::string_view but = {});

}  // namespace morsel::core
