// Axes and texts are drawn once, the curves for each picture.
#include "run/film_chart.h"

#include <fmt/format.h>

#include "overlay/marks.h"
#include "overlay/text_block.h"
#include "physics/body_now.h"
#include "physics/energy.h"
#include "scene/scene.h"
#include "std.h"

namespace carom {
namespace {

constexpr size_t most_single_momenta = 5;  // bodies with a curve of their own
constexpr Color chart_ground = from_rgb(0x15181d), grid_color = from_rgb(0x2d323a), frame_color = from_rgb(0x6b737f);
constexpr Color quiet_text = from_rgb(0xb4bcc8), sum_color = from_rgb(0xffffff);
constexpr uint32_t axis_colors[] = {0xff6b5e, 0x6fcf6a, 0x62a8ff};  // of x, y and z
constexpr double letters_across = 18, letters_down = 17;            // of the chart's sides
constexpr double least_letters = 5;                                 // pixels

struct ChartQuantity {
  const char* of;  // before the body's name
  string_view unit;
  bool from_zero;
};
// In the order of Quantity.
constexpr ChartQuantity chart_quantities[] = {
    {"x of", "m", false},   {"y of", "m", false},   {"z of", "m", false},      {"vx of", "m/s", true},
    {"vy of", "m/s", true}, {"vz of", "m/s", true}, {"speed of", "m/s", true}, {"kinetic energy of", "J", true}};

/// A colour that is light enough to be seen on the dark ground, of the same hue.
Color lightened(const Color& color) {
  const double light = 0.3 * color.r + 0.59 * color.g + 0.11 * color.b, least = 0.5;
  if (light >= least) return color;
  const double share = (least - light) / (1 - light);
  const auto part = [share](double c) { return c + share * (1 - c); };
  return {part(color.r), part(color.g), part(color.b)};
}

Color curve_color(const Scene& scene, Entity body) {
  const BodyRange& range = scene.roster.range_of(body);
  return lightened(range.coloring ? body_color(scene.look, body) : range.color);
}

}  // namespace

ChartCurves::ChartCurves(const Scene& scene) : scene_(scene), subject_(*scene.output.video->chart) {
  const size_t bodies = scene.world.body_count();
  switch (subject_.kind) {
    case ChartSubject::Kind::energy:
      title_ = "energy";
      unit_ = "J";
      curves_ = {{"kinetic", from_rgb(0xffa94d)}, {"potential", from_rgb(0x62a8ff)}, {"total", sum_color}};
      break;

    case ChartSubject::Kind::momentum:
      title_ = "momentum";
      unit_ = "kg m/s";
      if (bodies > most_single_momenta) {
        for (size_t axis = 0; axis < 3; ++axis)
          curves_.push_back({fmt::format("sum along {:c}", int('x' + axis)), from_rgb(axis_colors[axis])});
      } else {
        for (Entity i = 0; i < bodies; ++i) curves_.push_back({scene.roster.name(i), curve_color(scene, i)});
        curves_.push_back({"sum", sum_color});
      }
      break;

    case ChartSubject::Kind::body: {
      const ChartQuantity& text = chart_quantities[size_t(subject_.quantity)];
      title_ = fmt::format("{} {}", text.of, scene.roster.name(subject_.body));
      unit_ = text.unit;
      from_zero_ = text.from_zero;
      curves_ = {{scene.roster.name(subject_.body), curve_color(scene, subject_.body)}};
      break;
    }
  }
}

/// Of momenta of single bodies all three components, body by body.
vector<double> ChartCurves::all_values(const State& state) const {
  const World& world = scene_.world;
  constexpr double none = numeric_limits<double>::quiet_NaN();
  if (subject_.kind == ChartSubject::Kind::energy) {
    const double kinetic = kinetic_energy(world, state), potential = potential_energy(world, state);
    return {kinetic, potential, kinetic + potential};
  }

  if (subject_.kind == ChartSubject::Kind::body) {
    const Entity body = subject_.body;
    if (is_gone(state, body)) return {none};
    return {quantity_of(subject_.quantity, state.position[body], state.velocity[body], mass_now(world, state, body))};
  }

  vector<double> values;
  const auto add = [&](const Vec3& p) { values.insert(values.end(), {p.x(), p.y(), p.z()}); };
  for (Entity i = 0; world.body_count() <= most_single_momenta && i < world.body_count(); ++i)
    add(is_gone(state, i) ? Vec3::Constant(none) : Vec3(mass_now(world, state, i) * state.velocity[i]));
  add(momentum(world, state));
  return values;
}

vector<double> ChartCurves::values(const State& state) const {
  vector<double> all = all_values(state);
  if (!axis_) return all;
  vector<double> along;
  for (size_t i = *axis_; i < all.size(); i += 3) along.push_back(all[i]);
  return along;
}

void ChartCurves::take(const State& state) {
  times_.push_back(state.time);
  taken_.push_back(all_values(state));
}

void ChartCurves::settle() {
  if (subject_.kind != ChartSubject::Kind::momentum || curves_.back().name != "sum") return;
  array<double, 3> greatest{};
  for (const vector<double>& values : taken_)
    for (size_t i = 0; i < values.size(); ++i)
      if (isfinite(values[i])) greatest[i % 3] = max(greatest[i % 3], std::abs(values[i]));
  const size_t axis = size_t(ranges::max_element(greatest) - greatest.begin());

  for (vector<double>& values : taken_) {
    for (size_t i = 0; 3 * i + axis < values.size(); ++i) values[i] = values[3 * i + axis];
    values.resize(curves_.size());
  }
  axis_ = axis;
  title_ += fmt::format(" along {:c}", int('x' + axis));
}

FilmChart::FilmChart(const Scene& scene)
    : scene_(scene),
      layout_(layout_of(*scene.output.video)),
      font_(find_font(),
            max(least_letters, min({scene.output.video->size.height / 38.0, layout_.chart.width / letters_across,
                                    layout_.chart.height / letters_down}))),
      curves_(scene),
      from_(scene.output.video->from),
      until_(max(from_, min(scene.output.video->until.value_or(infinity), end_of(scene)))) {}

Ticks FilmChart::instants() const {
  return Ticks::even(from_ < until_ ? 2 * layout_.chart.width + 1 : 1, from_, until_);
}

void FilmChart::settle() {
  curves_.settle();
  double low = infinity, high = -infinity;
  for (const vector<double>& values : curves_.taken())
    for (const double value : values)
      if (isfinite(value)) low = min(low, value), high = max(high, value);
  if (!(low <= high)) low = high = 0;
  if (curves_.from_zero()) low = min(low, 0.0), high = max(high, 0.0);

  const Size size = layout_.chart;
  const double letters = font_.size();
  const PlotAxis flat = linear_axis(low, high, 6);
  const double room = 0.05 * (flat.to - flat.from);
  axis_ = linear_axis(flat.from - room, flat.to + room, 6);
  time_axis_ = linear_axis(from_, until_, 4);

  // From above: the title, a line for each curve, the plot, its ticks and the name of the time axis.
  // A single curve has its value beside the title.
  const size_t lines = curves_.curves().size() > 1 ? curves_.curves().size() : 0;
  const double head = letters * (2.2 + 1.4 * double(lines)), foot = 3.2 * letters;
  double ticks = 0;
  for (const PlotTick& tick : axis_.ticks) ticks = max(ticks, font_.width(tick.text));
  const double left = 1.6 * letters + ticks, right = size.width - 1.3 * letters;
  const double high_most = size.height - head - foot - 1.6 * letters;
  const double height = max(letters, min(high_most, 1.15 * (right - left)));

  head_ = max(0.8 * letters, (size.height - head - height - foot) / 2) + letters;
  upper_left_ = {std::round(left) + 0.5, std::round(head_ - letters + head) + 0.5};
  lower_right_ = {std::round(right) + 0.5, std::round(upper_left_.y + height) + 0.5};
  draw_axes();
}

PixelPoint FilmChart::spot_of(double time, double value) const {
  const double across = clamp(time_axis_.part(time), 0.0, 1.0), up = clamp(axis_.part(value), 0.0, 1.0);
  return {upper_left_.x + across * (lower_right_.x - upper_left_.x),
          lower_right_.y - up * (lower_right_.y - upper_left_.y)};
}

void FilmChart::draw_axes() {
  const Size size = layout_.chart;
  Canvas& canvas = still_.emplace(size.width, size.height);
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) canvas.add(x, y, chart_ground);

  Coverage grid(size.width, size.height), frame(size.width, size.height), text(size.width, size.height);
  const double letters = font_.size();
  for (const PlotTick& tick : axis_.ticks) {
    const double y = std::round(spot_of(from_, tick.at).y - 0.5) + 0.5;
    draw_line({upper_left_.x, y}, {lower_right_.x, y}, 1, tick.at == 0 ? frame : grid);
    font_.draw(tick.text, upper_left_.x - 0.5 * letters - font_.width(tick.text), y + 0.36 * letters, text);
  }
  for (const PlotTick& tick : time_axis_.ticks) {
    const double x = std::round(spot_of(tick.at, axis_.from).x - 0.5) + 0.5;
    draw_line({x, lower_right_.y}, {x, upper_left_.y}, 1, grid);
    font_.draw(tick.text, x - font_.width(tick.text) / 2, lower_right_.y + 1.3 * letters, text);
  }

  draw_line(upper_left_, {upper_left_.x, lower_right_.y}, 1, frame);
  draw_line({upper_left_.x, lower_right_.y}, lower_right_, 1, frame);
  const string below = time_axis_.label("time", "s");
  font_.draw(below, (upper_left_.x + lower_right_.x - font_.width(below)) / 2, lower_right_.y + 2.7 * letters, text);

  Coverage title(size.width, size.height);
  const double space = lower_right_.x - letters - (curves_.curves().size() == 1 ? 7 * letters : 0);
  font_.draw(shortened(font_, axis_.label(curves_.title(), string(curves_.unit())), space), letters, head_, title);
  canvas.add(grid, grid_color);
  canvas.add(frame, frame_color);
  canvas.add(text, quiet_text);
  canvas.add(title, text_color);
}

/// The line of each curve above the plot: its name, and its value now.
void FilmChart::draw_values(const vector<double>& now, Canvas& canvas) const {
  const double letters = font_.size(), scale = max(std::abs(axis_.from), std::abs(axis_.to));
  Coverage text(canvas.width(), canvas.height());
  const bool single = now.size() == 1;
  double y = head_ + (single ? 0 : 1.7 * letters);
  for (size_t i = 0; i < now.size(); ++i, y += 1.4 * letters) {
    const string value = isfinite(now[i]) ? fmt::format("{} {}", three_digits(now[i], scale), curves_.unit()) : "";
    const double left = 3 * letters, right = lower_right_.x - font_.width(value);
    font_.draw(value, right, y, text);
    if (single) break;

    font_.draw(shortened(font_, curves_.curves()[i].name, right - left - letters), left, y, text);
    Coverage dash(canvas.width(), canvas.height());
    draw_line({1.2 * letters, y - 0.33 * letters}, {2.4 * letters, y - 0.33 * letters}, max(1.5, letters / 6), dash);
    canvas.add(dash, curves_.curves()[i].color);
  }
  canvas.add(text, text_color);
}

void FilmChart::draw_curve(size_t curve, const State& state, const vector<double>& now, Canvas& canvas) const {
  const double width = max(1.3, font_.size() / 8);
  Coverage ink(canvas.width(), canvas.height());
  optional<PixelPoint> before;
  const auto to = [&](double time, double value) {
    optional<PixelPoint> spot;
    if (isfinite(value)) spot = spot_of(time, value);
    if (spot && before) draw_line(*before, *spot, width, ink);
    before = spot;
  };

  for (size_t i = 0; i < curves_.times().size() && curves_.times()[i] < state.time; ++i)
    to(curves_.times()[i], curves_.taken()[i][curve]);
  to(state.time, now[curve]);
  if (before) draw_disc(*before, 2.2 * width, ink);
  canvas.add(ink, curves_.curves()[curve].color);
}

const Image& FilmChart::beside(const Image& picture, const State& state) {
  const Size size = scene_.output.video->size;
  whole_.width = size.width;
  whole_.height = size.height;
  whole_.channels = picture.channels;
  whole_.pixels.resize(size_t(size.height) * whole_.row_size());
  for (int y = 0; y < picture.height; ++y)
    std::copy_n(picture.row(y), picture.row_size(), whole_.pixels.data() + size_t(y) * whole_.row_size());

  Canvas canvas = *still_;
  const vector<double> now = curves_.values(state);
  // The first one, of a body or the kinetic energy, above the others.
  for (size_t i = now.size(); i-- > 0;) draw_curve(i, state, now, canvas);
  draw_values(now, canvas);
  canvas.lay_onto(whole_, layout_.left, layout_.top);
  return whole_;
}

}  // namespace carom
