#include "morsel/tools/formats/base64.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <span>
#include <string>

using namespace morsel;

TEST_CASE("Base64 as RFC 4648 gives it, and back") {
  const std::string text = "foobar";
  const char* const expected[] = {"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t size = 0; size <= text.size(); ++size) {
    CHECK(tools::base64(text.substr(0, size)) == expected[size]);
    CHECK(tools::decoded_base64(expected[size]) == text.substr(0, size));
    CHECK(tools::decoded_base64(expected[size] + std::string("\n<Zg==")) == text.substr(0, size));
  }
}

TEST_CASE("Base64 of bytes in parts is that of all of them") {
  std::mt19937 random(5);
  std::string bytes;
  for (int i = 0; i < 1000; ++i) bytes += static_cast<char>(random() % 256);
  const std::string whole = tools::base64(bytes);
  CHECK(tools::decoded_base64(whole) == bytes);
  for (std::size_t most : {1, 2, 3, 5, 100}) {
    tools::Base64Encoder encoder;
    std::string text;
    for (std::size_t at = 0; at < bytes.size();) {
      const std::size_t some = std::min(random() % (most + 1), bytes.size() - at);
      encoder.encode(std::as_bytes(std::span(bytes)).subspan(at, some), text);
      at += some;
    }
    encoder.finish(text);
    CHECK(text == whole);
  }
}

TEST_CASE("digits that are no whole groups are refused") {
  for (const char* text : {"Z", "Zg", "Zg=", "Zg===", "Z===", "====", "=Zg=", "Zm9vYg=", "Zg==Zg=="})
    CHECK(!tools::decoded_base64(text));
}
