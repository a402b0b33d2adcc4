#include "morsel/tools/plot/layout.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

#include "morsel/core/error.h"
#include "morsel/core/text/numbers.h"
#include "morsel/tools/plot/ranges.h"

namespace morsel::tools::plot {
namespace {

constexpr Color kText = 0x000000, kQuiet = 0x555555;
constexpr double kShape = 0.68;            // height of a frame, of its width
constexpr double kInfinityBand = 14;       // above the finite part, for the line of +∞
constexpr double kPanelGap = 9;            // at least
constexpr double kNumberGap = 5;           // between numbers side by side
constexpr double kTickGap = 2;             // between a tick and its number
constexpr double kLegendGap = 12;          // between its columns
constexpr double kMarksAnArea = 0.2;       // at most, of a series in a panel, of a square point of it
constexpr std::size_t kMarkedPoints = 25;  // of a line, to be marked
constexpr double kLineSample = 16, kMarkSample = 5;  // widths in the legend
constexpr double kSmallestTitle = 6;                 // that a long title is made smaller to
constexpr double kDescent = 0.24;                    // of DejaVu Sans, of the em
constexpr double kHalfHeight = 0.365;                // of its capitals and digits

/// Makes the layout from top to bottom.
class Layouter {
 public:
  Layouter(const Plot& plot, drawing::Lettering& lettering)
      : plot_(plot), lettering_(lettering), ranges_(ranges_of(plot)) {
    layout_.width = plot.width;
    layout_.infinity = ranges_.infinity;
    layout_.infinity_depth = kInfinityBand / 2;
  }

  Layout make() {
    columns_ = std::min(plot_.columns, plot_.panels.size());
    measure_axes();
    y_ = kMargin;
    title();
    panels();
    legend();
    notes();
    layout_.height = y_ + kMargin;
    return std::move(layout_);
  }

 private:
  void add_line(Spot spot, std::string text, double size, Color color, Align align = Align::left,
                bool upwards = false) {
    if (!text.empty()) layout_.lines.push_back({spot, std::move(text), {size, color, align, upwards}});
  }

  static std::string axis_text(const Axis& axis, const Ticks& ticks) {
    std::string unit = ticks.factor == 0 ? "" : power_of_ten(ticks.factor);
    if (!axis.unit.empty()) unit += (unit.empty() ? "" : " ") + axis.unit;
    std::string text = axis.label;
    // The label is the value without the offset.
    if (!ticks.offset_text.empty()) {
      const bool negative = ticks.offset < 0;
      const std::string digits =
          negative ? ticks.offset_text.substr(std::string("\u2212").size()) : ticks.offset_text;
      text += (negative ? " + " : " \u2212 ") + digits;
    }
    if (!unit.empty()) text += (text.empty() ? "(" : " (") + unit + ")";
    return text;
  }

  double widest(const Ticks& ticks) {
    double width = 0;
    for (const Tick& tick : ticks.major) width = std::max(width, lettering_.width(tick.label, kTickSize));
    return width;
  }

  /// Whether the numbers have room side by side on an axis of this length.
  bool fit(const Ticks& ticks, double length) {
    for (std::size_t i = 0; i + 1 < ticks.major.size(); ++i) {
      const Tick &a = ticks.major[i], &b = ticks.major[i + 1];
      const double apart = length * (place(b.value, ranges_.x, plot_.x) - place(a.value, ranges_.x, plot_.x));
      const double needed = (lettering_.width(a.label, kTickSize) + lettering_.width(b.label, kTickSize)) / 2;
      if (apart < needed + kNumberGap) return false;
    }
    return true;
  }

  /// Names, each to the room between its neighbours.
  void shorten(Ticks& ticks) {
    const double room = frame_width_ / ranges_.x.size() - kNumberGap;
    for (Tick& tick : ticks.major) tick.label = lettering_.shortened(tick.label, kTickSize, room);
  }

  /// From 0 at the lower end of the axis to 1 at the upper.
  static double place(double value, Interval range, const Axis& axis) {
    const double lower = along(range.lower, axis);
    return (along(value, axis) - lower) / (along(range.upper, axis) - lower);
  }

  /// The ticks and with them the size of a panel.
  void measure_axes() {
    left_ = kMargin + 50;  // to begin with: what numbers and label of y take
    right_ = kMargin;
    const auto n = static_cast<double>(columns_);
    for (int round = 0; round < 3; ++round) {
      frame_width_ = (plot_.width - left_ - right_ - (n - 1) * gap_) / n;
      if (frame_width_ < 20)
        throw core::InvalidArgument("cannot draw a plot: " + std::to_string(columns_) +
                                    " panels side by side have no room in its width");
      finite_height_ = plot_.diagonal ? frame_width_ : std::round(kShape * frame_width_);
      y_ticks_ = make_ticks(ranges_.y, plot_.y, std::max(2, static_cast<int>(finite_height_ / 22)));
      int count = plot_.diagonal ? std::max(2, static_cast<int>(finite_height_ / 22)) : 10;
      do x_ticks_ = make_ticks(ranges_.x, plot_.x, count);
      while (!fit(x_ticks_, frame_width_) && --count > 1);
      if (!plot_.x.names.empty() && !fit(x_ticks_, frame_width_)) shorten(x_ticks_);
      if (plot_.diagonal) y_ticks_ = x_ticks_;
      left_ = kMargin + (plot_.y.label.empty() && axis_text(plot_.y, y_ticks_).empty() ? 0 : kLabelSize + 4) +
              widest(y_ticks_) + kTickGap + kTickLength;
      double before = 0, over = 0;  // how far the first number and the last one stand out beyond the frame
      for (const Tick& tick : x_ticks_.major) {
        const double half = lettering_.width(tick.label, kTickSize) / 2;
        const double x = frame_width_ * place(tick.value, ranges_.x, plot_.x);
        before = std::max(before, half - x);
        over = std::max(over, half - (frame_width_ - x));
      }
      gap_ = std::max(kPanelGap, before + over + kNumberGap);
      right_ = kMargin + over;
    }
    frame_height_ = finite_height_ + (ranges_.infinity ? kInfinityBand : 0);
    const double top = frame_height_ - finite_height_;
    for (const Tick& tick : x_ticks_.major)
      layout_.x_major.push_back(frame_width_ * place(tick.value, ranges_.x, plot_.x));
    for (const double value : x_ticks_.minor)
      layout_.x_minor.push_back(frame_width_ * place(value, ranges_.x, plot_.x));
    const auto depth = [&](double value) {
      return top + finite_height_ * (1 - place(value, ranges_.y, plot_.y));
    };
    for (const Tick& tick : y_ticks_.major) layout_.y_major.push_back(depth(tick.value));
    for (const double value : y_ticks_.minor) layout_.y_minor.push_back(depth(value));
  }

  void title() {
    if (plot_.title.empty()) return;
    y_ += kTitleSize;
    add_line({kMargin, y_}, lettering_.shortened(plot_.title, kTitleSize, plot_.width - 2 * kMargin),
             kTitleSize, kText);
    y_ += 7;
  }

  void panels() {
    const std::size_t count = plot_.panels.size();
    const bool titles = std::any_of(plot_.panels.begin(), plot_.panels.end(),
                                    [](const Panel& p) { return !p.title.empty(); });
    const bool captions = std::any_of(plot_.panels.begin(), plot_.panels.end(),
                                      [](const Panel& p) { return !p.caption.empty(); });
    const double head = (titles ? kPanelSize + 3 : 0) + (captions ? kCaptionSize + 3 : 0);
    const double first_top = y_ + head;
    double widest_title = 0;
    for (const Panel& panel : plot_.panels)
      widest_title = std::max(widest_title, lettering_.width(panel.title, kPanelSize));
    const double title_size =
        std::clamp(kPanelSize * frame_width_ / std::max(widest_title, 1.), kSmallestTitle, kPanelSize);
    double bottom = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Panel& panel = plot_.panels[i];
      const std::size_t row = i / columns_, column = i % columns_;
      const Box frame{left_ + static_cast<double>(column) * (frame_width_ + gap_),
                      first_top + static_cast<double>(row) * (frame_height_ + kPanelGap + head), frame_width_,
                      frame_height_};
      double above = frame.y - head;
      if (titles) {
        above += kPanelSize;
        add_line({frame.x, above}, lettering_.shortened(panel.title, title_size, frame_width_), title_size,
                 kText);
        above += 3;
      }
      if (captions)
        add_line({frame.x, above + kCaptionSize},
                 lettering_.shortened(panel.caption, kCaptionSize, frame_width_), kCaptionSize, kQuiet);
      if (i % columns_ == 0) y_numbers(frame);
      if (i + columns_ >= count) x_numbers(frame);
      bottom = std::max(bottom, frame.bottom());
      layout_.panels.push_back(drawn(panel, frame));
    }
    // The label of y stands beside all rows; that of x beneath the last of them.
    const double middle = (first_top + bottom) / 2;
    add_line({kMargin + kLabelSize * (1 - kDescent), middle},
             lettering_.shortened(axis_text(plot_.y, y_ticks_), kLabelSize, bottom - first_top), kLabelSize,
             kText, Align::center, true);
    y_ = bottom + kTickLength + kTickGap + kTickSize;
    const std::string text = axis_text(plot_.x, x_ticks_);
    if (!text.empty()) {
      const double width = static_cast<double>(columns_) * (frame_width_ + gap_) - gap_;
      y_ += kLabelSize + 2;
      add_line({left_ + width / 2, y_}, lettering_.shortened(text, kLabelSize, width), kLabelSize, kText,
               Align::center);
    }
    y_ += kDescent * kLabelSize;
  }

  void y_numbers(const Box& frame) {
    const double x = frame.x - kTickLength - kTickGap;
    for (std::size_t k = 0; k < y_ticks_.major.size(); ++k)
      add_line({x, frame.y + layout_.y_major[k] + kHalfHeight * kTickSize}, y_ticks_.major[k].label,
               kTickSize, kText, Align::right);
    if (ranges_.infinity)
      add_line({x, frame.y + layout_.infinity_depth + 0.3 * kTickSize}, "\u221e", kTickSize, kText,
               Align::right);
  }

  void x_numbers(const Box& frame) {
    for (std::size_t k = 0; k < x_ticks_.major.size(); ++k)
      add_line({frame.x + layout_.x_major[k], frame.bottom() + kTickLength + kTickGap + 0.78 * kTickSize},
               x_ticks_.major[k].label, kTickSize, kText, Align::center);
  }

  DrawnPanel drawn(const Panel& panel, const Box& frame) {
    DrawnPanel result;
    result.frame = frame;
    result.finite_top = frame.bottom() - finite_height_;
    const Box finite{frame.x, result.finite_top, frame_width_, finite_height_};
    if (plot_.diagonal) result.diagonal = {{finite.x, finite.bottom()}, {finite.right(), finite.y}};
    const auto spot = [&](double x, double y) {
      return Spot{finite.x + finite.width * place(x, ranges_.x, plot_.x),
                  std::isinf(y) ? frame.y + layout_.infinity_depth
                                : finite.bottom() - finite.height * place(y, ranges_.y, plot_.y)};
    };
    const auto most = static_cast<std::size_t>(kMarksAnArea * frame_width_ * finite_height_);
    for (const Series& series : panel.series) {
      if (series.x.empty()) continue;
      std::vector<Spot> spots;
      spots.reserve(series.x.size() * (series.draw == Draw::steps ? 2 : 1));
      for (std::size_t i = 0; i < series.x.size(); ++i) {
        if (series.draw == Draw::steps && i > 0)
          spots.push_back({spot(series.x[i], series.y[i]).x, spots.back().y});
        spots.push_back(spot(series.x[i], series.y[i]));
      }
      DrawnSeries drawn{&series, {}, {}, 0};
      if (series.draw == Draw::marks || series.x.size() == 1) {
        Marks marks = visible_marks(spots, ranges_.infinity ? frame : finite, most);
        if (marks.cell > 0) {
          thinned_ += spots.size();
          left_of_thinned_ += marks.spots.size();
          coarsest_ = std::max(coarsest_, marks.cell);
        }
        drawn.radius = spots.size() <= 200 ? 1.7 : spots.size() <= 2000 ? 1.3 : 1;
        if (columns_ > 1) drawn.radius *= 0.8;
        drawn.marks = std::move(marks.spots);
      } else {
        drawn.lines = visible_line(spots, finite);
        if (series.draw == Draw::line && spots.size() <= kMarkedPoints) {
          drawn.marks = visible_marks(spots, finite, most).spots;
          drawn.radius = 1.5;
        }
      }
      result.series.push_back(std::move(drawn));
    }
    return result;
  }

  /// In as many columns as have room, filled one after the other.
  void legend() {
    std::vector<const Series*> named;
    std::vector<double> widths;
    std::set<std::string> names;
    bool lines = false;
    for (const Panel& panel : plot_.panels)
      for (const Series& series : panel.series) lines |= !series.name.empty() && series.draw != Draw::marks;
    layout_.sample = lines ? kLineSample : kMarkSample;
    const double all = plot_.width - 2 * kMargin, sample = layout_.sample + 4;
    for (const Panel& panel : plot_.panels)
      for (const Series& series : panel.series)
        if (!series.name.empty() && names.insert(series.name).second) {
          named.push_back(&series);
          widths.push_back(std::min(all, sample + lettering_.width(series.name, kLegendSize)));
        }
    if (named.empty()) return;
    std::size_t rows = 1;
    std::vector<double> columns = legend_columns(widths, rows);
    const auto total = [&] {
      return std::accumulate(columns.begin(), columns.end(),
                             kLegendGap * (static_cast<double>(columns.size()) - 1));
    };
    while (columns.size() > 1 && total() > all) columns = legend_columns(widths, ++rows);
    // Below the frames, if it is not wider than they.
    double x = total() <= plot_.width - kMargin - left_ ? left_ : kMargin;
    text_left_ = x;
    y_ += 7;
    for (std::size_t i = 0; i < named.size(); ++i) {
      if (i > 0 && i % rows == 0) x += columns[i / rows - 1] + kLegendGap;
      const double y = y_ + static_cast<double>(i % rows) * (kLegendSize + 3) + kLegendSize;
      layout_.legend.push_back({{x, y - kHalfHeight * kLegendSize}, named[i]});
      add_line({x + sample, y}, lettering_.shortened(named[i]->name, kLegendSize, columns[i / rows] - sample),
               kLegendSize, kText);
    }
    y_ += static_cast<double>(rows) * (kLegendSize + 3) - 3 + kDescent * kLegendSize;
  }

  /// How wide the columns of entries of these widths are, so many in each.
  static std::vector<double> legend_columns(const std::vector<double>& widths, std::size_t rows) {
    std::vector<double> columns((widths.size() + rows - 1) / rows, 0);
    for (std::size_t i = 0; i < widths.size(); ++i)
      columns[i / rows] = std::max(columns[i / rows], widths[i]);
    return columns;
  }

  void notes() {
    std::vector<std::string> notes = plot_.notes;
    if (thinned_ > 0) {
      const auto tenths = static_cast<int>(std::ceil(coarsest_ * 10 - 1e-9));
      notes.push_back("Of " + core::grouped(thinned_) + " crowded marks " + core::grouped(left_of_thinned_) +
                      " are drawn: one in each square of " + std::to_string(tenths / 10) + "." +
                      std::to_string(tenths % 10) + " points.");
    }
    bool first = true;
    for (const std::string& note : notes)
      for (const std::string& line : broken(note)) {
        y_ += first ? 5 : 2;
        first = false;
        y_ += kNoteSize;
        add_line({text_left_, y_}, lettering_.shortened(line, kNoteSize, plot_.width - kMargin - text_left_),
                 kNoteSize, kQuiet);
      }
    if (!first) y_ += kDescent * kNoteSize;
  }

  /// Into lines that have room, at spaces.
  std::vector<std::string> broken(const std::string& text) {
    std::vector<std::string> lines;
    std::string line;
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t end = std::min(text.find(' ', i), text.size());
      const std::string word = text.substr(i, end - i);
      const std::string longer = line.empty() ? word : line + " " + word;
      if (!line.empty() && lettering_.width(longer, kNoteSize) > plot_.width - kMargin - text_left_) {
        lines.push_back(line);
        line = word;
      } else {
        line = longer;
      }
      i = end + 1;
    }
    if (!line.empty()) lines.push_back(line);
    return lines;
  }

  const Plot& plot_;
  drawing::Lettering& lettering_;
  Ranges ranges_;
  Ticks x_ticks_, y_ticks_;
  Layout layout_;
  std::size_t columns_ = 1;
  double left_ = 0, right_ = 0, frame_width_ = 0, finite_height_ = 0, frame_height_ = 0, gap_ = kPanelGap;
  double text_left_ = kMargin;  // where legend and notes begin
  double y_ = 0;                // how far down it is full
  std::size_t thinned_ = 0, left_of_thinned_ = 0;
  double coarsest_ = 0;
};

}  // namespace

Layout lay_out(const Plot& plot, drawing::Lettering& lettering) {
  drawing::check_text(plot.title);
  return Layouter(plot, lettering).make();
}

}  // namespace morsel::tools::plot
