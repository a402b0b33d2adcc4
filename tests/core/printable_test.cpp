#include "morsel/core/text/printable.h"

#include <catch2/catch.hpp>
#include <string>

using morsel::core::json_printable;
using morsel::core::printable;

TEST_CASE("control characters are escaped, all other text is kept") {
  CHECK(printable("").empty());
  CHECK(printable("plain, \\ and \"quoted\"") == "plain, \\ and \"quoted\"");
  CHECK(printable("\xc3\xa9 \xe2\x82\xac \xf0\x9f\x90\xb0") == "\xc3\xa9 \xe2\x82\xac \xf0\x9f\x90\xb0");
  CHECK(printable("a\nb\tc\rd") == "a\\nb\\tc\\rd");
  CHECK(printable("\x1b[2Jred\x07") == "\\x1b[2Jred\\x07");
  CHECK(printable(std::string("\0\x7f", 2)) == "\\x00\\x7f");
  CHECK(printable("\xc2\x80\xc2\x9b\xc2\x9f\xc2\xa0") == "\\u0080\\u009b\\u009f\xc2\xa0");
  CHECK(printable("\xe2\x80\xae\xe2\x81\xa6\xe2\x80\xa8\xef\xbf\xbe") == "\\u202e\\u2066\\u2028\\ufffe");
  CHECK(printable("a\nb\tc\x01", "\n\t") == "a\nb\tc\\x01");
}

TEST_CASE("bytes that are not UTF-8 are escaped one by one") {
  CHECK(printable("\xff") == "\\xff");
  CHECK(printable("\x9b[2J") == "\\x9b[2J");                                // C1 as one byte
  CHECK(printable("\xc3") == "\\xc3");                                      // cut off
  CHECK(printable("\xe2\x82") == "\\xe2\\x82");                             // likewise
  CHECK(printable("\xc0\xaf\xe0\x80\x9b") == "\\xc0\\xaf\\xe0\\x80\\x9b");  // longer than needed
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");                    // a surrogate
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");           // above the last character
  CHECK(printable("\xc3(") == "\\xc3(");
}

TEST_CASE("JSON text has what is not printable as escapes of JSON") {
  CHECK(json_printable("{\n  \"a\\n\": \"b\"\n}", "\n") == "{\n  \"a\\n\": \"b\"\n}");
  CHECK(json_printable("\xc3\xa9 \xf0\x9f\x90\xb0") == "\xc3\xa9 \xf0\x9f\x90\xb0");
  CHECK(json_printable("\x1b\x7f\n") == "\\u001b\\u007f\\u000a");
  CHECK(json_printable("\xc2\x9b\xe2\x80\xae\xe2\x81\xa6\n", "\n") == "\\u009b\\u202e\\u2066\n");
  CHECK(json_printable("\xff\x7f") == "\xff\\u007f");
}

TEST_CASE("what printable() escapes in UTF-8 json_printable() escapes, and nothing else") {
  for (unsigned code = 0x80; code < 0xd800; ++code) {
    std::string text;
    if (code < 0x800)
      text = {static_cast<char>(0xc0 | code >> 6), static_cast<char>(0x80 | (code & 0x3f))};
    else
      text = {static_cast<char>(0xe0 | code >> 12), static_cast<char>(0x80 | (code >> 6 & 0x3f)),
              static_cast<char>(0x80 | (code & 0x3f))};
    REQUIRE(json_printable(text) == printable(text));
  }
}

TEST_CASE("no bytes leave a control character") {
  std::string all;
  for (int i = 0; i < 256; ++i)
    for (int k = 0; k < 256; k += 5) all += {static_cast<char>(i), static_cast<char>(k)};
  const std::string shown = printable(all);
  for (const char c : shown) CHECK((c < 0 || (c >= ' ' && c != '\x7f')));
  CHECK(printable(shown) == shown);
}
