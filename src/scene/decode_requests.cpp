// Decodes the requests of a scene: how to simulate, what to show, what to write.
// The table of fields fills the structs. The checks here concern several keys at once, or the budget.
#include <fmt/format.h>

#include "physics/force.h"
#include "physics/world.h"
#include "scene/decode.h"
#include "scene/engines.h"
#include "scene/fields.h"
#include "scene/film_format.h"
#include "scene/film_layout.h"
#include "scene/member.h"
#include "scene/output_kinds.h"
#include "scene/scene.h"
#include "scene/sheet_layout.h"
#include "std.h"
#include "yaml/joined.h"
#include "yaml/values.h"

namespace carom {
namespace {

class Requests {
 public:
  Requests(const Node& root, const Inventory& inventory, const LoadOptions& options, Scene& scene,
           Diagnostics& diagnostics)
      : root_(root),
        inventory_(inventory),
        budget_(options.budget),
        chooses_outputs_(options.chooses_outputs),
        scene_(scene),
        diagnostics_(diagnostics) {}

  void run() {
    simulate();
    lights();
    background();
    output();
    if (budget_.enforced) check_budget();
  }

 private:
  void simulate() {
    const View view = scene_part(root_, "simulate");
    Simulate& s = scene_.simulate;
    fill(&s, view);
    if (s.engine == Engine::book && view.given("step") == nullptr) s.step = 1.0 / 60;
    if (view.given("integrator") == nullptr) s.integrator = s.step ? Integrator::rk4 : Integrator::dop853;
    if (s.as_printed && s.engine != Engine::book) {
      diagnostics_.add(view.place("as_printed"), "`as_printed` needs `engine: book`",
                       "only that engine follows the printed listings");
    }
  }

  void lights() {
    const Node* node = root_.find("lights");
    if (node == nullptr || !node->is_map()) return;

    for (size_t i = 0; i < node->keys.size(); ++i) {
      if (node->keys[i].text == "ambient") {
        scene_.ambient = as_color(&node->items[i]);
        continue;
      }

      if (node->items[i].find_key("repeat") != nullptr) continue;  // no member
      const View view(&node->items[i], kind_named("light"), node->keys[i].place);
      Light& light = scene_.lights.emplace_back();
      light.name = node->keys[i].text;
      fill(&light, view);
    }
  }

  void background() {
    const View whole(&root_, kind_named("scene"), Place{});
    scene_.background.color = whole.color("background");
    scene_.background.transparent = whole.text("background") == "none";
  }

  void output() {
    Output& out = scene_.output;
    const Node* node = root_.find("output");
    if (node == nullptr) {
      out.trajectory.emplace();
      out.collisions = true;
      out.energy.emplace();
      return;
    }

    const Key& key = *root_.find_key("output");
    const View view(node, kind_named("output"), key.place);
    fill(&out, view);

    if (out.trajectory && inventory_.fits) {
      const Node* on = view.part("trajectory").find("on");
      if (auto bodies = find_bodies(on, inventory_, "it has no rows", diagnostics_))
        out.trajectory->bodies = std::move(*bodies);
    }

    using Tables = TablesOutput;
    if (out.tables.separator == Tables::Separator::comma && out.tables.decimal == Tables::Decimal::comma)
      diagnostics_.add(view.part("tables").place("decimal"),
                       "the separator of cells and the decimal mark are both commas",
                       "expected `{separator: \";\", decimal: \",\"}`, as spreadsheets with decimal commas have it");

    // The pictures.
    if (out.frames) check_window(view.part("frames"), out.frames->from, out.frames->until);
    if (out.video) check_video(view.part("video"), *out.video);
    if (out.video && !chooses_outputs_ && scene_.background.transparent &&
        film_format(out.video->file) == FilmFormat::mp4)
      diagnostics_.add(view.place("video"), "an MP4 has no transparency, and `background` is `none`",
                       "expected a `file` ending in .gif or .webp, `frames` or `sheet`, or a colour for `background`");
    if (out.sheet) check_sheet(view, *out.sheet);

    flights(view);
  }

  void flights(const View& view) {
    const optional<bool> said = view.flag("flights");
    const bool parabolas = goes_along_parabolas(scene_.world, scene_.simulate);
    scene_.output.flights = parabolas && said.value_or(scene_.output.pictures());
    if (parabolas || !said.value_or(false)) return;
    diagnostics_.add(view.place("flights"),
                     "`flights` need parabolas from impact to impact, and this scene has other paths",
                     "expected `flights: false`, or `engine: exact` under forces that are the same everywhere");
  }

  void check_video(const View& part, VideoOutput& video) {
    const bool plain =
        all_of(video.file, [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != '/' && c != '\\'; });
    const optional<FilmFormat> format = film_format(video.file);
    if (!plain || !format || video.file.size() > 200 || video.file[0] == '.' || video.file[0] == '-') {
      diagnostics_.add(part.place("file"), fmt::format("{} is not a name for a video", in_backticks(video.file)),
                       "expected a plain file name that ends in .mp4, .gif or .webp, such as animation.mp4, without "
                       "folders");
    }

    if (video.size.width % 2 != 0 || video.size.height % 2 != 0) {
      diagnostics_.add(part.place("size"),
                       fmt::format("a video of {} x {} pixels", video.size.width, video.size.height),
                       "expected an even width and height: its colours (yuv420p) are stored for 2 x 2 pixels");
    }

    if (video.sound && format && *format != FilmFormat::mp4)
      diagnostics_.add(part.place("sound"), fmt::format("{} has no sound", film_name(*format)),
                       "expected a `file` ending in .mp4, or `sound: false`");

    if (video.slow && video.slow->around == "none") video.slow.reset();
    if (video.slow) find_slow(part.part("slow"), *video.slow);
    if (format == FilmFormat::gif) check_gif(part, video);
    if (format) check_limits(part, video, *format);
    check_window(part, video.from, video.until);
    decode_film_parts(part, inventory_, scene_.title, video, diagnostics_);
  }

  void find_slow(const View& part, SlowSettings& slow) {
    const Node* around = part.given("around");
    if (around == nullptr || slow.around == "auto") return;
    const auto range = find_range(*around, inventory_, Sought::bodies, diagnostics_);
    if (!range || !inventory_.fits) return;

    slow.first = range->first;
    slow.count = range->count;
    if (range->first < inventory_.body_count && range->count > 0) return;
    diagnostics_.add(
        around->place,
        fmt::format("{} {}: a film slows down around collisions of bodies", in_backticks(around->text),
                    range->count == 0 ? "has no balls" : fmt::format("is {}", inventory_.word_for(*range))),
        "expected auto, none, a ball, body, group or member (gas.3)");
  }

  void check_sheet(const View& output, SheetOutput& sheet) {
    const View part = output.part("sheet");
    check_window(part, sheet.from, sheet.until);
    if (chooses_outputs_ || !diagnostics_.empty()) return;
    const Output& out = scene_.output;
    const Size shape = out.frames ? out.frames->size : out.video ? out.video->size : Size{};
    if (const optional<SheetProblem> problem = problem_of(sheet, shape))
      diagnostics_.add(sheet.size ? part.place("size") : output.place("sheet"), problem->message, problem->remedy);
  }

  void check_limits(const View& part, const VideoOutput& video, FilmFormat format) {
    const FilmLimits limits = limits_of(format);
    const Size size = video.size;
    const string film = fmt::format("{} of {} x {} pixels", film_name(format), size.width, size.height);

    if (max(size.width, size.height) > limits.longest_side)
      diagnostics_.add(part.place("size"), film,
                       fmt::format("expected at most {} pixels a side, the limit of this format, or a `file` ending in "
                                   ".mp4",
                                   limits.longest_side - limits.longest_side % 2));
    else if (!fits_ffmpeg(size))
      diagnostics_.add(part.place("size"), film,
                       "expected fewer pixels, such as [16384, 16128]: ffmpeg takes (width + 128) x (height + 128) up "
                       "to 268435455");

    if (format != FilmFormat::gif && (video.fps < limits.lowest_fps || video.fps > limits.highest_fps))
      diagnostics_.add(part.place("fps"),
                       fmt::format("{} of {} pictures a second", film_name(format), shortest(video.fps)),
                       fmt::format("expected a number {}: {}", describe({limits.lowest_fps, limits.highest_fps}),
                                   limits.why_of_fps));
  }

  /// A rate of the film's own stays as it is. That of frames, or the default, becomes one that a GIF keeps.
  void check_gif(const View& part, VideoOutput& video) {
    const Node* own = part.own() == nullptr ? nullptr : part.own()->find("fps");
    if (own == nullptr) {
      video.fps = gif_rate(video.fps);
      if (part.given("fps") == nullptr && scene_.output.frames) scene_.output.frames->fps = video.fps;
      return;
    }
    if (own->bad || keeps_rate(FilmFormat::gif, video.fps)) return;
    // In the scene of a run every film has a rate. Then a setting must replace it.
    const bool by_setting = place_of(*part.given("file")).source > own->place.source;
    const string rates = by_setting ? fmt::format("--set output.video.fps={}, or", shortest(gif_rate(video.fps)))
                                    : "50, 25, 20, 12.5, 10 or";
    diagnostics_.add(
        own->place, fmt::format("a GIF cannot show {} pictures a second", shortest(video.fps)),
        fmt::format("expected {} another 100/n: a GIF shows each picture for whole hundredths of a second, at least 2",
                    rates));
  }

  void check_window(const View& part, double from, optional<double>& until) {
    const double duration = scene_.simulate.duration;
    if (!scene_part(root_, "simulate").number("duration")) return;
    if (from > duration) {
      diagnostics_.add(part.place("from"),
                       fmt::format("`from` is {} but the scene ends at {} s", shortest(from), shortest(duration)),
                       fmt::format("expected at most {}", shortest(duration)));
    } else if (until && *until < from) {
      diagnostics_.add(part.place("until"),
                       fmt::format("`until` is {} but `from` is {}", shortest(*until), shortest(from)),
                       "expected from <= until");
    }
    // Nothing happens after the scene's end.
    if (until) until = min(*until, duration);
  }

  double count(const FramesOutput& frames) const {
    const double until = frames.until.value_or(scene_.simulate.duration);
    return max(0.0, floor(until * frames.fps) - ceil(frames.from * frames.fps) + 1);
  }

  double count(const VideoOutput& video) const {
    const double until = video.until.value_or(scene_.simulate.duration);
    const double length = (until - video.from) / video.speed + (video.slow ? most_delay() : 0);
    return max(0.0, floor(length * video.fps) + 1) + double(title_pictures(video));
  }

  void check_budget() {
    const Output& out = scene_.output;
    const View view(root_.find("output"), kind_named("output"),
                    root_.find_key("output") ? root_.find_key("output")->place : Place{});

    const auto refuse = [&](Place place, double figure, string_view what, uint64_t limit, string_view change) {
      diagnostics_.add(place, fmt::format("the run would write {:.15g} {}; the limit is {}", figure, what, limit),
                       fmt::format("expected {}, or --force to allow it", change));
    };

    // Rows and the like.
    const double bodies = inventory_.fits ? inventory_.body_count : 0;
    for (const Excess& excess : excesses(out, scene_.simulate.duration, bodies, budget_)) {
      const OutputKind& kind = *excess.kind;
      const bool unsaid = view.own() == nullptr;
      refuse(unsaid ? scene_part(root_, "simulate").place("duration") : view.part(kind.name).place(kind.spacing),
             excess.figure, excess.what, excess.limit,
             unsaid ? "`output: {trajectory: {every: ...}}` with a longer time between rows"
                    : fmt::format("a {} `{}`, a shorter duration or fewer bodies",
                                  kind.spacing == "every" ? "longer" : "lower", kind.spacing));
    }
    // Frames and a video of the same instants share their pictures.
    double total = 0, most = -1;
    string_view largest = "frames";
    const auto add = [&](double n, string_view key) {
      total += n;
      if (n > most) {
        most = n;
        largest = key;
      }
    };

    if (out.frames) add(count(*out.frames), "frames");
    const bool shared = out.frames && out.video && out.video->speed == 1 && !out.video->chart &&
                        static_cast<const PictureOutput&>(*out.frames) == *out.video &&
                        std::remainder(out.video->from * out.video->fps, 1) == 0;
    if (out.video) add(shared ? double(title_pictures(*out.video)) : count(*out.video), "video");
    if (out.sheet) add(double(out.sheet->columns) * out.sheet->rows, "sheet");

    if (total > double(budget_.frames)) {
      const Key* key = view.own() == nullptr ? nullptr : view.own()->find_key(largest);
      const bool slow = largest == "video" && out.video->speed < 1;
      const bool too_slow = slow && most * out.video->speed <= double(budget_.frames);
      refuse(key == nullptr ? view.where() : view.part(largest).place(too_slow ? "speed" : "fps"), total, "pictures",
             budget_.frames,
             slow ? "a higher `speed`, a lower `fps` or a shorter duration" : "a lower `fps` or a shorter duration");
    }
  }

  const Node& root_;
  const Inventory& inventory_;
  const Budget& budget_;
  bool chooses_outputs_;
  Scene& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace

void check_engine(const Node& root, const Scene& scene, Diagnostics& diagnostics) {
  const View simulate = scene_part(root, "simulate");
  for (const Unsupported& lack : unsupported(scene.world, scene.simulate)) {
    const Key* key = root.find_key(lack.at);
    diagnostics.add(key != nullptr ? key->place : simulate.place(lack.at), lack.what, lack.instead);
  }
}

void check_steps(const Node& root, const Scene& scene, const Budget& budget, Diagnostics& diagnostics) {
  const optional<double> steps = steps_of(scene);
  const double bodies = scene.world.body_count();
  if (!steps) return;
  const bool many = *steps > double(budget.steps);
  if (!many && *steps * bodies <= double(budget.body_steps)) return;

  const View simulate = scene_part(root, "simulate");
  const bool said = simulate.given("step") != nullptr;
  const Key* forces = root.find_key("forces");
  const string figure = many ? fmt::format("{:.4g} time steps; the limit is {}", *steps, budget.steps)
                             : fmt::format("{:.4g} time steps for {}; the limit is {} in all", *steps,
                                           how_many(scene.world.body_count(), "body", "bodies"), budget.body_steps);

  diagnostics.add(said || forces == nullptr ? simulate.place(said ? "step" : "duration") : forces->place,
                  fmt::format("the run would take {}", figure),
                  said ? "expected a longer `step` or a shorter duration, or --force to allow it"
                       : "steps follow the fastest change of a force: expected forces that change more slowly, a "
                         "`step` or a shorter duration, or --force to allow it");
}

void decode_requests(const Node& root, const Inventory& inventory, const LoadOptions& options, Scene& scene,
                     Diagnostics& diagnostics) {
  Requests(root, inventory, options, scene, diagnostics).run();
}

}  // namespace carom
