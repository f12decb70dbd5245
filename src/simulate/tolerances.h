#pragma once
// Every constant that decides the accuracy of the simulators, of the choice of a step, and of the book simulator.
// "Share of a radius", "of a speed" and the like mean a factor of that quantity.
// Brackets hold two measurements by ./dev bench tolerances: with 4 times the constant, and with a quarter of it.
// Each is the greatest displacement of a body, as a share of its radius, in nine short runs.
// In them - means no displacement, and * a pile that rests too late or a run that fails. Constants without brackets
// have none of these effects.

#include "std.h"

namespace carom::exact_tolerance {

// Rounding.

// Share of speeds: rounding of a component. [9e-20 1e-14]
inline constexpr double velocity_rounding = 0x1p-48;
// Share of coordinates: a displacement that is rounding.
inline constexpr double position_rounding = 0x1p-48;
// Share of the time since a flight's start: the rounding of two roots at one place of a path.
inline constexpr double crossing_rounding = 0x1p-50;
// Share of a radius: lower elastic hops that drag shortens without end are over.
inline constexpr double fading_hop = 0x1p-32;
// Share of coordinates: a gap to a flat surface by the rounding of a scene's numbers.
inline constexpr double flat_rounding = 0x1p-50;
// Share of coordinates: a gap to any other thing by the rounding of a scene's numbers.
inline constexpr double initial_rounding = 0x1p-46;
// Share of a distance: bodies that pass by farther apart do not touch.
inline constexpr double near_miss = 0x1p-20;
// Multiple of a radius: beyond it, collisions use the relative path of two bodies.
inline constexpr double far_from_origin = 0x1p13;
// Share of a radius: rims no farther apart are adjacent.
inline constexpr double rim_gap = 0x1p-40;
// rad: greatest angle between surfaces that take over from each other.
inline constexpr double level = 1e-6;
// Share of the clock: with no more progress in a million events it stands still (stall_guard.h).
inline constexpr double clock_rounding = 0x1p-46;
// Share of the duration: with less progress a run would never end.
inline constexpr double least_progress = 0x1p-30;
// Multiple of the speed of falling by a radius: rounding. [3e-10 2e-10]
inline constexpr double step_rounding = 512;
// Share of speeds: an approach to a plane that is rounding. [3e-10 2e-10]
inline constexpr double plane_rounding = 0x1p-49;
// Share of accelerations: a difference on curves that is rounding.
inline constexpr double curve_rounding = 0x1p-43;
// Share of a radius or a coordinate: allowed error of polynomials beside a closed form.
inline constexpr double closed_place = 0x1p-48;
// Share of speeds: the same. These polynomials only serve to find impacts.
inline constexpr double closed_speed = 0x1p-20;
// Consecutive explicit steps that a braking force limits, after which the implicit method is tried.
inline constexpr uint8_t many_explicit_steps = 8;
// Share of the greatest speed so far: a speed that counts as zero, because its square underflows.
inline constexpr double negligible_speed = 0x1p-200;
// Share of the squared speed of falling by a radius: below it, a body is at rest.
inline constexpr double negligible_hop = 0x1p-120;
// Share of speeds: an approach that is rounding, where nothing presses.
inline constexpr double approach_rounding = 0x1p-50;

// Impacts that end in contact (collapse_detector.h).

// Share of the speed of falling by a length: a slower approach is no impact in contact. [4e-7 4e-2]
inline constexpr double slow_impact = 0.03;
// Share of a length: impacts within it are at one place.
inline constexpr double collapse_gap = 1e-9;
// The sum of 1 - e of impacts at one place that makes a collapse. It leaves exp(-8) of the speeds.
inline constexpr double collapse_loss = 16;
// Slow impacts of a body on flat surfaces within the time of a hop. [- 2e-15]
inline constexpr int burst_on_surfaces = 256;
// The same among bodies. [6e-8 6e-6]
inline constexpr int burst_of_bodies = 16;
// Share of a radius: an impact that lifts a held body by less does not wake it.
inline constexpr double waking_lift = 1e-4;
// Volume of three unit normals that hold a body on all sides.
inline constexpr double least_volume = 1e-3;

// Share of a radius: in less room between things that certainly close in on a body, the run ends with an error.
inline constexpr double least_gap = 0x1p-10;

// Islands (exact_group.h).

// Share of a radius: bodies within this gap of a waking body wake too.
inline constexpr double waking_gap = 1e-6;
// Impacts at one instant (impact_set.h).

// Share of the time until an impact: another one may fall on the same instant.
inline constexpr double tie_of_flight = 0x1p-20;
// Share of the clock: the same.
inline constexpr double tie_of_clock = 0x1p-36;
// Share of the time in which the fastest body crosses the scene, or the duration: the same, by rounding of places.
inline constexpr double tie_of_places = 0x1p-34;
// So many events of one instant may be endless rounds. Whether they are is then looked at.
inline constexpr uint32_t rounds_of_events = 1000;
// Cosine of an angle: pushes at right angles.
inline constexpr double right_angle = 0x1p-40;
// Share of a speed: two approaches that are equal.
inline constexpr double equal_speeds = 0x1p-32;
// Share of the greatest speed of an instant: a component of a velocity that is zero.
inline constexpr double nothing_left = 0x1p-90;
// Share of the greatest impulse of an instant: an impulse that later rounds have taken back.
inline constexpr double impulse_rounding = 0x1p-48;
// Share of speeds: a string that shortens by more slackens.
inline constexpr double slackening = 0x1p-40;
// Share of speeds: a pair that separates faster stays closed no longer.
inline constexpr double parted = 0x1p-44;
// So many strikes of one body at an instant may be endless rounds.
inline constexpr uint32_t many_strikes = 32;
// Share of the greatest speeds of an instant, by kinetic energy: what rounding leaves of approaches after many rounds.
inline constexpr double left_by_rounds = 0x1p-40;
// Share of the greatest speeds of an instant, by kinetic energy: the limit of endless rounds has not changed.
inline constexpr double same_limit = 1e-13;
// The same: the limit is reached.
inline constexpr double limit_reached = 0x1p-50;
// Sum of 1 - e for each row that presses in the limit, after which rounds leave nothing: ln 2^52.
inline constexpr double rounds_of_limit = 36;
// Sum of 1 - e over the impacts of one body, from which on the limit is taken as it is: masses over six decades.
inline constexpr double worn_out = 1024;

// Constrained motion (constrained_motion.h).

// Share of a radius: a gap that counts as contact. [5e-16 4e-16]
inline constexpr double contact_gap = 1e-9;
// Share of coordinates: the same.
inline constexpr double contact_rounding = 0x1p-51;
// Share of a radius: a deeper overlap is closed. [5e-15 2e-14]
inline constexpr double least_overlap = 0x1p-50;
// Share of the least radius and of speeds: error of a step, and of parabolas on curved surfaces.
inline constexpr double step_error = 1e-12;
// Share of a radius and of speeds: allowed error of a contact after steps. Slower islands in balance fall asleep.
inline constexpr double drift = 16e-12;
// Share of the time in which bodies move by a radius: length of the first step.
inline constexpr double first_step = 0.05;
// Share of that time: an interval in which nothing happens but impacts at one place.
inline constexpr double moment = 0x1p-22;
// rad: a swing this near to its turn is there.
inline constexpr double extreme = 1e-6;
// Share of a step: precision of the time of a change.
inline constexpr double time_precision = 0x1p-40;
// Share of the greatest acceleration: a greater acceleration of a gap is more than rounding.
inline constexpr double opening = 1e-12;
// Multiple of that: the contact has opened.
inline constexpr double opened = 10;
// Multiple of that: greatest acceleration of a gap at the instant that is found for an opening.
inline constexpr double wide_open = 1000;
// Share of the time of falling by a radius, in which changes of contact are counted.
inline constexpr double time_of_changes = 0.04;
// Changes of contact in that time. With more, the island moves as a crowd.
inline constexpr uint32_t many_changes = 64;
// Steps of a crowd without a change of contact. After so many, the island returns to constrained motion.
inline constexpr uint32_t calm_steps = 8;
// Share of the greatest acceleration: forces are in balance.
inline constexpr double constrained_balance = 1e-11;
// Part of the accelerations. Where the rounding of a string's force or direction makes more, the motion is arbitrary.
inline constexpr double arbitrary = 1e-3;
// Share of a speed: a contact has changed it.
inline constexpr double velocity_change = 0x1p-40;
// Multiple of a radius over the greatest speed: time in which an unloaded body may return to contact.
inline constexpr double free_time = 1e-6;

// Crowds (crowd_motion.h, crowd_list.h). The table of qualities has the others (contact_quality.h).

// Steps for which a list is made, at most.
inline constexpr double steps_of_list = 6;
// Share of a radius: what bodies may go before the list is made anew, at least and at most.
inline constexpr double least_reach = 0.01;
inline constexpr double greatest_reach = 0.4;
// Multiple of what a body may go in a step: the same.
inline constexpr double reach_of_need = 1.25;
// Share of a radius: room of a member's region, at least.
inline constexpr double room_of_region = 0.5;
// Members of a crowd's slab, at least, and its thickness by the length of most rows. Threads take slabs.
inline constexpr size_t members_of_slab = 1000;
inline constexpr double rows_through_slab = 3;
// Share of the last step: a shorter one begins anew.
inline constexpr double restart = 0.5;
// Steps without a force, after which a body that is near nothing leaves its crowd.
inline constexpr uint8_t idle_steps = 8;
// Multiple of the last step: the longest one.
inline constexpr double step_growth = 1.25;
// Share of a gap that errors of a step may take.
inline constexpr double share_of_gap = 0.7;
// The same where less than half of the shell is left.
inline constexpr double share_below = 0.3;
// Share of a radius, and of speeds: rounding of a gap and of forces.
inline constexpr double gap_rounding = 1e-10;
// Share of the speed of bodies in contact: what forces may leave, where a step gives bodies more.
inline constexpr double force_of_speed = 0.3;
// The same, where it gives them less.
inline constexpr double least_force = 0.01;
// Members of a crowd, up to which the contact solver takes steps that sweeps have not solved.
inline constexpr size_t exact_members = 200;
// Steps in which missing gaps do not return, at most, after one in which they could not.
inline constexpr int longest_wait = 64;
// Share of the energy that a crowd turns over: once errors have made more, missing gaps do not return.
inline constexpr double made_with_returns = 1e-5;
// Times as fast as a missing gap, an overlap by rounding ends. Its speed is that of tremors, at most.
inline constexpr double quick_return = 1000;
// Rounds of sweeps over pairs that would overlap, after which a step is shortened; and how often it is.
inline constexpr int more_sweeps = 32;
inline constexpr int most_shortenings = 6;
// Times the way by which a shell bends: what a step aims at where contact has no gap.
inline constexpr double bent_aim = 1.25;
// Rounds in which balls are kept from shells that bend.
inline constexpr int bent_rounds = 4;
// What a step leaves of the shells of a crowd that is calm.
inline constexpr double shell_decay = 0.875;
// Share of a radius: a crowd with narrower shells can go over to constrained motion.
inline constexpr double closed_shell = 1e-10;
// Share of the greatest acceleration: a body is held by forces with a smaller sum.
inline constexpr double balance = 1e-11;
// The same, before a last correction: sweeps have left rounding, and no motion.
inline constexpr double nearly_balanced = 1e-6;
// Sweeps that may look for the forces that hold a large crowd.
inline constexpr int sweeps_to_rest = 20000;
// Share of the speed of falling by a radius: slower bodies may be at rest.
inline constexpr double standstill = 1e-4;
// The same: forces of slower bodies need not be finer. Their errors add up to tremors at a tenth of a standstill.
inline constexpr double tremor = 1e-5;
// Steps from one look at the parts of a crowd to the next, and looks after which a part that slow rests.
inline constexpr uint32_t steps_to_look = 8;
inline constexpr uint8_t still_looks = 8;
// Share of the speed of falling by a radius: the mean speed of crowds that rest by it; and for how many times of
// falling.
inline constexpr double slow_preview = 0.03;
inline constexpr double slow_for = 5;

}  // namespace carom::exact_tolerance

namespace carom::accuracy_tolerance {

// Which steps meet a tolerance (engine/accuracy.h).

// Instants of a run at which two runs are compared, at most.
inline constexpr int most_instants = 64;
// Positions kept for it, of all bodies together. With more bodies there are fewer instants.
inline constexpr double places_kept = 1e6;
// Place of each instant in its part of a run.
inline constexpr double golden = 0.6180339887498949;
// Share of speeds and masses: disturbance of a finer run by rounding.
inline constexpr double disturbance = 0x1p-50;
// Share of coordinates: the same. Contact of flat surfaces allows twice as much for two places (flat_rounding).
inline constexpr double place_disturbance = 0x1p-51;
// Share of a radius and of speeds: error of a step, so that its estimate holds.
inline constexpr double coarsest_error = 1e-6;
// The same: rounding.
inline constexpr double finest_error = 0x1p-50;
// Ratio of the step errors of two runs that are compared.
inline constexpr double finer = 64;
// Share of a tolerance: the first step error.
inline constexpr double first_share = 1e-3;
// Share of a tolerance: precision of the reference.
inline constexpr double reference_share = 0.125;
// Multiple of default_step (force.h): the first step.
inline constexpr double longest_choice = 64;
// A halving of steps that leaves more than this share of a difference is in vain.
inline constexpr double gain = 0.75;
// So many halvings in vain end the search.
inline constexpr int most_vain_halvings = 5;
// Steps of all bodies together in the longest run.
inline constexpr double most_steps = 3e7;
// Steps of a run from which on the cost of the tolerance is predicted. The search ends if it exceeds most_steps.
inline constexpr double few_steps = 1e5;
// Share of the smallest radius: the tolerance where a scene has none.
inline constexpr double default_tolerance = 0.01;
// Share of speeds and masses: a disturbance that is carried along. Its growth shows chaos.
inline constexpr double carried_disturbance = 1e-12;
// Share of the largest radius: a larger disturbance does not count as small.
inline constexpr double saturated = 0.01;
// Instants at which a disturbance must be small, so that its growth can be measured.
inline constexpr size_t least_small = 8;
// Share of the duration: a disturbance that becomes large within it is not followed more finely.
inline constexpr double clock_share = 1e-6;

}  // namespace carom::accuracy_tolerance

namespace carom::stepped_tolerance {

// The book simulator (book.h).

// Share of a frame: a time as near to a frame's time belongs to that frame.
inline constexpr double frame_rounding = 1e-9;

}  // namespace carom::stepped_tolerance
