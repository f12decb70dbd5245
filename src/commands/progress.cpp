// A bar redraws one line ten times a second. A log cannot be redrawn: it gets a line for each tenth of the work, or
// after 5 s.
#include "commands/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include "commands/text.h"
#include "numerics/whole.h"
#include "run/stopwatch.h"
#include "std.h"
#include "yaml/letters.h"

namespace carom {

namespace {

/// The choice of --progress for this stderr.
ProgressChoice progress_choice(const Options& options) {
  const bool terminal = is_terminal(STDERR_FILENO);
  if (options.progress == ProgressChoice::automatic && options.quiet) return ProgressChoice::none;
  if (options.progress == ProgressChoice::automatic) return terminal ? ProgressChoice::bar : ProgressChoice::lines;
  // A bar redraws its line, which only a terminal can.
  return options.progress == ProgressChoice::bar && !terminal ? ProgressChoice::lines : options.progress;
}

// Whole seconds: the estimate is no more precise.
string left_text(double left) {
  if (!isfinite(left)) return "";
  const double whole = ceil(left);
  return (whole < 60 ? fmt::format("{:.0f} s", whole) : wait_text(whole)) + " left";
}

}  // namespace

Progress::Progress(const Options& options, string name, bool shown)
    : choice_(shown ? progress_choice(options) : ProgressChoice::none),
      color_(uses_color(options.color, STDERR_FILENO)),
      name_(std::move(name)) {}

Progress::~Progress() {
  clear();
}

void Progress::clear() {
  if (drawn_) draw_line("");
  drawn_ = false;
}

void Progress::draw_bar(double done, const string& counts, const string& left) {
  // One line, narrower than the terminal: a wrapped line cannot be drawn over.
  const size_t width = terminal_width(STDERR_FILENO) - 1;
  constexpr size_t bar_width = 20;

  string text = fmt::format("{} ", name_);
  if (letters_of(text) + bar_width + 24 < width) {
    const auto full = size_t(whole_below(clamp(done, 0.0, 1.0) * bar_width));
    const Palette palette(color_);
    string rest = fmt::format(" {:3.0f} % ", min(99.0, done * 100));
    const size_t taken = letters_of(text) + bar_width + 2 + rest.size();
    rest += taken + letters_of(counts) <= width ? counts : left;
    text += fmt::format("[{}{}{}{:{}}]{}", palette.green, string(full, '='), palette.reset, "", bar_width - full, rest);
  } else {
    text = fmt::format("{:3.0f} %", done * 100);
  }

  draw_line(text);
  drawn_ = true;
}

void Progress::begin_early() {
  last_ = start_ - std::chrono::seconds(1);
  tenth_ = -1;
}

void Progress::store(double done) {
  if (shared_ != nullptr) shared_->store(clamp(done, 0.0, 1.0), std::memory_order_relaxed);
}

bool Progress::due() const {
  if (choice_ == ProgressChoice::none) return false;
  return since(last_) >= (choice_ == ProgressChoice::bar ? 0.1 : 2.0);
}

/// "1,830/s", or per minute for slower rates.
string Progress::rate(double count) const {
  const double per_second = elapsed() > 0 ? count / elapsed() : 0;
  if (per_second < 1) return fmt::format("{:.2g}/min", 60 * per_second);
  return per_second < 10 ? fmt::format("{:.2g}/s", per_second) : grouped(uint64_t(whole_below(per_second))) + "/s";
}

double Progress::elapsed() const {
  return since(start_);
}

/// The time to come (s), where this part of the work is done.
double Progress::left(double done) {
  pace_.note(elapsed(), done);
  return (1 - done) * pace_.rate();
}

/// left_s: the time to come (s).
void Progress::show(double done, double left_s, const string& what) {
  const Clock::time_point now = Clock::now();
  const double since_last = std::chrono::duration<double>(now - last_).count();
  const string left = left_text(left_s);
  const string counts = left.empty() ? what : what + ", " + left;

  if (choice_ == ProgressChoice::bar) {
    draw_bar(done, counts, left);
  } else {
    const int tenth = int(whole_below(clamp(done, 0.0, 1.0) * 10));
    // At the end the result is printed instead.
    if (tenth == 10 || (tenth == tenth_ && since_last < 5)) return;
    tenth_ = tenth;
    write_err(fmt::format("{}: {:.0f} %, {}\n", name_, done * 100, counts));
  }
  last_ = now;
}

void Progress::update(const RunProgress& progress) {
  if (!run_) return;
  run_->note(elapsed(), progress);
  store(run_->share());
  if (due()) show(run_->share(), run_->left(), run_->text());
}

void Progress::update(size_t done, size_t of, string_view things, const string& more) {
  if (!due()) return;
  const auto count = double(done);
  const double share = count / double(max<size_t>(of, 1));
  show(share, left(share), fmt::format("{} of {} {} ({}){}", grouped(done), grouped(of), things, rate(count), more));
}

void Progress::update(double done, const string& what) {
  store(done);
  if (!due()) return;
  const double share = clamp(done, 0.0, 1.0);
  show(share, left(share), what);
}

}  // namespace carom
