#pragma once
/// A text in memory, line by line and word by word: what the readers of text formats share. Internal.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "morsel/core/parallel/progress.h"

namespace morsel::core {

/// Throws the BadInput of a file that cannot be read: `cannot read "x.off": what`.
[[noreturn]] void fail_reading(const std::string& file, const std::string& what);

/// A piece of a file as an error message may show it: quoted, short, printable.
std::string shown(std::string_view word);

/// Iterates over the lines that have a word, and over the words of the current line. Lines end with \n, \r\n,
/// or (in a file without any \n) \r. Independent of locales. Errors name the file and the line. Reports
/// progress and checks for cancellation every 65,536 lines and words.
class TextScanner {
 public:
  struct Syntax {
    char comment = '#';         ///< starts a comment that ends with the line; 0: there are none
    bool continuation = false;  ///< a \ at a line's end joins the next line, also without a blank before it
    char terminator = 0;        ///< of a line: \n or \r; 0: \r if the text has no \n
  };

  /// Keeps views of `text` and references to `file` and `progress`, which must outlive it.
  TextScanner(std::string_view text, const std::string& file, Syntax syntax, const Progress& progress);

  /// Goes to the next line that has a word; false at the end of the text.
  bool next_line();
  /// Goes to the very next line, blank or not.
  bool next_raw_line();
  /// Whether the current line has no more words.
  bool at_line_end();
  /// The next word of this line; empty at its end.
  std::string_view word();
  /// The next word of the text, on this line or a later one; empty at the end of the text.
  std::string_view word_on_any_line();

  /// The next word as a number ("1", "-.5e3", "+2", "nan", "inf"); `what` is for the error if it is none.
  double number(std::string_view what);
  /// The same, rounded to single precision.
  double single_number(std::string_view what);
  /// The next word as a whole number.
  std::int64_t integer(std::string_view what);
  /// The same where one with decimals that are 0 ("3.0") is taken as well.
  struct Whole {
    std::int64_t value;
    bool has_decimals;
  };
  Whole whole_number(std::string_view what);
  /// The whole number that follows in this line, up to the first character that is no digit, without
  /// consuming it.
  std::int64_t leading_integer(std::string_view what);
  /// The next word of this line, without consuming it.
  std::string_view peek_word() const;
  /// Whether the word that the scanner is in ends here.
  bool at_word_end() const { return ends_word(cursor_); }
  /// The next character of this line (0 at its end), and consuming it.
  char peek() const { return cursor_ < line_end_ ? *cursor_ : '\0'; }
  void skip() { ++cursor_; }

  /// Characters from the start of the next line to the end of the text.
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - next_); }
  /// The same as a view.
  std::string_view rest() const { return {next_, remaining()}; }
  /// Characters from here to the end of the text, those of this line included.
  std::size_t remaining_here() const { return static_cast<std::size_t>(end_ - cursor_); }
  std::size_t line() const { return line_; }
  char terminator() const { return terminator_; }  ///< of lines: \n or \r
  /// Throws BadInput naming the file and this line.
  [[noreturn]] void fail(const std::string& what) const;
  /// Throws BadInput for a text that ends too early.
  [[noreturn]] void fail_at_end(const std::string& what) const;

 private:
  template <class Float>
  double parse(std::string_view what);
  /// Whether a word ends before this character of the line.
  bool ends_word(const char* c) const;
  /// Whether the line goes on with the next one from here.
  bool is_continuation(const char* c) const;
  /// After each line and word.
  void advance() {
    if ((++steps_ & 0xFFFF) == 0) report();
  }
  void report() const;

  const char* begin_;
  const char* end_;
  const char* next_;              // start of the next line
  const char* cursor_ = nullptr;  // in the current line
  const char* line_end_ = nullptr;
  std::size_t line_ = 0;
  std::size_t steps_ = 0;  // lines and words gone past
  char terminator_ = '\n';
  Syntax syntax_;
  const std::string& file_;
  const Progress& progress_;
};

}  // namespace morsel::core
