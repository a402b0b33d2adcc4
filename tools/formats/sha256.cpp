#include "morsel/tools/formats/sha256.h"

// The functions of the algorithm itself, which allocate nothing: those of EVP make tables at their first use,
// and crash where memory is short (libcrypto 3.0).
#define OPENSSL_SUPPRESS_DEPRECATED
#include <openssl/sha.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <vector>

#include "morsel/core/io/file_bytes.h"
#include "morsel/core/parallel/exhaustion.h"

namespace morsel::tools {
namespace {

class Sha256 {
 public:
  Sha256() { SHA256_Init(&state_); }
  void add(std::string_view bytes) { SHA256_Update(&state_, bytes.data(), bytes.size()); }
  std::string finish() {
    std::array<unsigned char, SHA256_DIGEST_LENGTH> digest{};
    SHA256_Final(digest.data(), &state_);
    std::string text;
    for (const unsigned char byte : digest) {
      constexpr const char* kDigits = "0123456789abcdef";
      text += kDigits[byte >> 4];
      text += kDigits[byte & 15];
    }
    return text;
  }

 private:
  SHA256_CTX state_{};
};

}  // namespace

std::string sha256_of_file(const std::filesystem::path& path) {
  const std::string what = "cannot read " + path.string();
  core::check_regular_file(path, what);
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) core::fail_to_read(errno, what);
  Sha256 hash;
  std::vector<char> buffer(std::size_t{1} << 20);
  while (in) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    hash.add({buffer.data(), static_cast<std::size_t>(in.gcount())});
  }
  if (in.bad()) core::fail_to_read(errno, what);
  return hash.finish();
}

std::string sha256_of(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.finish();
}

}  // namespace morsel::tools
