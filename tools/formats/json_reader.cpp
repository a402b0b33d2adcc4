#include "morsel/tools/formats/json_reader.h"
#include "morsel/core/parallel/exhaustion.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "morsel/core/error.h"

namespace morsel::tools {
namespace {

/// The document's bytes, a piece at a time: after each the limits are checked.
class Bytes {
 public:
  Bytes(std::istream& in, const std::string& name, const JsonLimits& limits)
      : stream_(&in), name_(name), limits_(limits), buffer_(kPiece) {}
  Bytes(std::string_view text, const std::string& name, const JsonLimits& limits)
      : text_(text), name_(name), limits_(limits) {}

  bool is_at_end() { return next_ == end_ && !refill(); }
  char current() { return is_at_end() ? '\0' : *next_; }
  void advance() {
    if (!is_at_end()) ++next_;
  }
  std::size_t position() const { return before_ + static_cast<std::size_t>(next_ - begin_); }
  /// A token ends here.
  void mark() { marked_ = position(); }

  [[noreturn]] void refuse(const std::string& why) const {
    throw core::BadInput(name_ + " is not JSON that can be read: " + why);
  }

 private:
  static constexpr std::size_t kPiece = 1 << 16;

  bool refill() {
    before_ = position();
    begin_ = next_ = end_ = nullptr;
    if (before_ - marked_ > limits_.token)
      refuse("at byte " + std::to_string(marked_) + " begins a text or number of more than " +
             std::to_string(limits_.token) + " bytes");
    std::size_t count = 0;
    if (stream_ != nullptr) {
      stream_->read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
      count = static_cast<std::size_t>(stream_->gcount());
      if (stream_->bad()) core::fail_to_read(errno, "cannot read " + name_ + " to its end");
      begin_ = buffer_.data();
    } else {
      count = std::min(kPiece, text_.size() - before_);
      begin_ = text_.data() + before_;
    }
    next_ = begin_;
    end_ = begin_ + count;
    if (count > 0 && before_ + count > limits_.bytes)
      refuse("it has more than " + std::to_string(limits_.bytes) + " bytes");
    return count > 0;
  }

  std::istream* stream_ = nullptr;
  std::string_view text_;
  const std::string& name_;
  const JsonLimits& limits_;
  std::vector<char> buffer_;
  const char* begin_ = nullptr;
  const char* next_ = nullptr;
  const char* end_ = nullptr;
  std::size_t before_ = 0;  // bytes before begin_
  std::size_t marked_ = 0;  // where the last token ended
};

/// An input iterator over these bytes; the one without bytes is the end.
struct ByteIterator {
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;

  Bytes* bytes = nullptr;

  char operator*() const { return bytes->current(); }
  ByteIterator& operator++() {
    bytes->advance();
    return *this;
  }
  ByteIterator operator++(int) { return ++*this; }
  friend bool operator==(const ByteIterator& a, const ByteIterator& b) {
    return a.is_at_end() == b.is_at_end();
  }

 private:
  bool is_at_end() const { return bytes == nullptr || bytes->is_at_end(); }
};

/// Builds the document from the events of nlohmann's parser, which does not recurse.
class Builder {
 public:
  Builder(Bytes& bytes, const JsonLimits& limits, JsonFollower& follower)
      : bytes_(bytes), limits_(limits), follower_(follower) {}

  Json take() { return std::move(document_); }

  bool null() { return scalar(nullptr); }
  bool boolean(bool value) { return scalar(value); }
  bool number_integer(std::int64_t value) { return scalar(value); }
  bool number_unsigned(std::uint64_t value) { return scalar(value); }
  bool number_float(double value, const std::string& /*text*/) { return scalar(value); }
  bool string(std::string& value) { return scalar(std::move(value)); }
  bool binary(Json::binary_t& /*value*/) { return false; }  // JSON texts have none
  bool start_object(std::size_t /*size*/) { return begin(Json::object()); }
  bool end_object() { return end(); }
  bool start_array(std::size_t /*size*/) { return begin(Json::array()); }
  bool end_array() { return end(); }

  bool key(std::string& name) {
    check_token(name.size());
    Json& object = *open_.back();
    slot_ = &object[name];
    if (object.size() > limits_.members)
      bytes_.refuse("the object at byte " + std::to_string(bytes_.position()) + " has more than " +
                    std::to_string(limits_.members) + " members");
    follower_.key(open_.size(), name);
    return true;
  }

  bool parse_error(std::size_t position, const std::string& /*token*/, const Json::exception& error) {
    constexpr int kNumberOverflow = 406;
    const std::string at = "byte " + std::to_string(position);
    if (error.id == kNumberOverflow) bytes_.refuse("the number that ends at " + at + " is too large");
    if (bytes_.is_at_end())
      bytes_.refuse("it is cut off, or wrong at its end, after " + std::to_string(bytes_.position()) +
                    " bytes");
    bytes_.refuse(at + " is unexpected");
  }

 private:
  void check_token(std::size_t size) {
    if (size > limits_.token)
      bytes_.refuse("the text that ends at byte " + std::to_string(bytes_.position()) + " has more than " +
                    std::to_string(limits_.token) + " bytes");
    bytes_.mark();
  }

  /// The place of the next value.
  Json& place() {
    if (open_.empty()) return document_;
    if (!open_.back()->is_array()) return *slot_;
    return open_.back()->emplace_back(nullptr);
  }

  bool scalar(Json value) {
    check_token(value.is_string() ? value.get_ref<const std::string&>().size() : 0);
    Json& here = place();
    here = std::move(value);
    ended(here);
    return true;
  }

  bool begin(Json container) {
    if (open_.size() >= limits_.depth)
      bytes_.refuse("at byte " + std::to_string(bytes_.position()) + " it is nested deeper than " +
                    std::to_string(limits_.depth) + " levels");
    bytes_.mark();
    follower_.begin(open_.size(), container.is_array());
    Json& here = place();
    here = std::move(container);
    open_.push_back(&here);
    return true;
  }

  bool end() {
    bytes_.mark();
    const Json& whole = *open_.back();
    open_.pop_back();
    ended(whole);
    return true;
  }

  void ended(const Json& value) {
    if (follower_.end(open_.size(), value) || open_.empty() || !open_.back()->is_array()) return;
    open_.back()->get_ref<Json::array_t&>().pop_back();
  }

  Bytes& bytes_;
  const JsonLimits& limits_;
  JsonFollower& follower_;
  Json document_;
  std::vector<Json*> open_;
  Json* slot_ = nullptr;  // of the member whose key was read
};

Json read(Bytes& bytes, const JsonLimits& limits, JsonFollower* follower) {
  JsonFollower none;
  Builder builder(bytes, limits, follower != nullptr ? *follower : none);
  if (!Json::sax_parse(ByteIterator{&bytes}, ByteIterator{}, &builder))
    bytes.refuse("it is damaged at byte " + std::to_string(bytes.position()));
  return builder.take();
}

}  // namespace

Json read_json(std::istream& in, const std::string& name, const JsonLimits& limits, JsonFollower* follower) {
  Bytes bytes(in, name, limits);
  return read(bytes, limits, follower);
}

Json read_json(std::string_view text, const std::string& name, const JsonLimits& limits,
               JsonFollower* follower) {
  Bytes bytes(text, name, limits);
  return read(bytes, limits, follower);
}

}  // namespace morsel::tools
