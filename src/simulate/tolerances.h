#pragma once
// Every constant that decides the accuracy of the simulators, of the choice of a step, and of the book simulator. "Of a
// radius", "of a speed", "of a step": a share of it. In brackets, as ./dev bench tolerances measures it: by how much of
// a radius, at most, a body is elsewhere in nine short runs with 4 times the constant, and with a quarter; - nowhere;
// * a pile rests too late or a run fails. No brackets: nothing of that.
#include <cstddef>
#include <cstdint>

namespace carom::exact_tolerance {

// Rounding.
inline constexpr double velocity_rounding = 0x1p-48;  // [9e-20 1e-14] of speeds: of a component, rounding
inline constexpr double position_rounding = 0x1p-48;  // of coordinates: a displacement that is rounding
inline constexpr double fading_hop = 0x1p-32;     // of a radius: elastic hops that drag shortens without end are over
inline constexpr double flat_rounding = 0x1p-50;  // of coordinates: a gap to a flat surface, in a scene's numbers
inline constexpr double initial_rounding = 0x1p-46;  // of coordinates: a gap to anything else, in a scene's numbers
inline constexpr double far_from_origin = 0x1p13;    // of a radius: beyond, bodies meet by their relative paths
inline constexpr double rim_gap = 0x1p-40;           // of a radius: rims no farther apart adjoin
inline constexpr double level = 1e-6;                // rad: between surfaces that take over from one another
inline constexpr double clock_rounding = 0x1p-46;  // of the clock: in a million events it stands still (stall_guard.h)
inline constexpr double least_progress = 0x1p-30;  // of the duration: in fewer, a run would never end
inline constexpr double step_rounding = 512;       // [3e-10 2e-10] of the speed of falling by a radius: rounding
inline constexpr double plane_rounding = 0x1p-49;  // [3e-10 2e-10] of speeds: an approach to a plane that is rounding
inline constexpr double curve_rounding = 0x1p-43;  // of accelerations: a difference on curves that is rounding
inline constexpr double told_fade = 0x1p-4;      // of a fade's time: so long its first eight terms tell it to rounding
inline constexpr double faded = 64;              // times of a fade: then nothing is left of it
inline constexpr double closed_place = 0x1p-48;  // of a radius, a coordinate: polynomials beside a closed form,
inline constexpr double closed_speed = 0x1p-20;  // and of speeds: they only find impacts
inline constexpr std::uint8_t many_explicit_steps = 8;  // held up by what brakes: the implicit method is tried
inline constexpr double negligible_speed = 0x1p-200;    // of the greatest speed so far: products with itself underflow
inline constexpr double negligible_hop = 0x1p-120;      // of the squared speed of falling by a radius: a body at rest
inline constexpr double approach_rounding = 0x1p-50;    // of speeds: an approach that is rounding: unpressed, or kicked

// Impacts that end in contact (collapse_detector.h).
inline constexpr double slow_impact = 0.03;    // [4e-7 4e-2] of the speed of falling by a length: no impact in contact
inline constexpr double collapse_gap = 1e-9;   // of a length: impacts within it are at one place
inline constexpr int collapse_impacts = 64;    // [- 7e-15] at one place, of a collapse,
inline constexpr double collapse_loss = 16;    // and their sum of 1 - e, which leaves exp(-8) of the speeds
inline constexpr int unloaded_impacts = 8;     // at one place in lasting contact, where nothing presses
inline constexpr int burst_on_surfaces = 256;  // [- 2e-15] slow impacts of a body on flat surfaces in a hop
inline constexpr int burst_of_bodies = 16;     // [6e-8 6e-6] the same among bodies
inline constexpr double waking_lift = 1e-4;    // of a radius: an impact that lifts a held body by less does not wake it
inline constexpr double least_volume = 1e-3;   // of three unit normals: they hold a body on all sides

// The contact group (exact_group.h).
inline constexpr double waking_gap = 1e-6;     // of a radius: what touches a body that wakes, wakes
inline constexpr double widest_margin = 2e-2;  // of a radius: what bodies that were just struck are kept apart

// Simultaneous impacts (simultaneous_impacts.h).
inline constexpr std::uint32_t few_impacts = 3;       // [2e-11 1e-10] of a member between steps are one by one
inline constexpr double simultaneous_parting = 0.01;  // of the fastest approach: what those struck at once part with
inline constexpr double simultaneous_slack = 1e-3;    // [1e-14 7e-15] of the fastest approach: what may be left
inline constexpr double open_margin = 0.5;            // of the widest margin: wider, those struck at once part
inline constexpr std::size_t pairs_of_a_step = 16;    // by member: solving for so many costs as much as a step

// Constrained motion (constrained_motion.h).
inline constexpr double contact_gap = 1e-9;          // [5e-16 4e-16] of a radius: a gap that counts as contact
inline constexpr double contact_rounding = 0x1p-51;  // of coordinates: the same
inline constexpr double least_overlap = 0x1p-50;     // [5e-15 2e-14] of a radius: a deeper overlap is closed
inline constexpr double step_error = 1e-12;  // of the least radius, and of speeds: a step's, and of parabolas in it
inline constexpr double drift = 16e-12;      // of a radius, and of speeds: what steps may leave of a contact
inline constexpr double first_step = 0.05;   // of the time in which bodies move by a radius: the first step
inline constexpr double moment = 0x1p-22;    // of that time: nothing happens in it but impacts at one place
inline constexpr double time_precision = 0x1p-40;  // of a step: to which the time of a change is found
inline constexpr double opening = 1e-12;   // of the greatest acceleration: of a gap, that is more than rounding,
inline constexpr double opened = 10;       // so often: the contact has opened,
inline constexpr double wide_open = 1000;  // at last
inline constexpr std::uint32_t many_changes = 64;  // of contacts in the time of a time step: then it moves by those
inline constexpr std::uint32_t calm_steps = 8;  // time steps in which no contact changes: then it moves by them no more
inline constexpr double constrained_balance = 1e-11;  // of the greatest acceleration: forces in balance
inline constexpr double velocity_change = 0x1p-40;    // of a speed: a contact has changed it
inline constexpr double free_time = 1e-6;             // of a radius over the greatest speed: to come back in, unloaded

// Time stepping (time_stepping.h).
inline constexpr double shortest_step = 0.04;           // [1e-2 6e-3] of the time of falling by a radius
inline constexpr double longest_step = 25;              // [- 6e-3] of the shortest step
inline constexpr double step_displacement = 0.04;       // [1e-1 3e-2] of a radius: of the fastest body in longer steps
inline constexpr double fast_impact = 8;                // of slow_speed: bodies that approach faster strike each other
inline constexpr double slow_slack = 1e-2;              // of the fastest slow approach: what a step's forces may take
inline constexpr double pressing_gap = 1e-3;            // of a radius: bodies no farther apart may press in a step
inline constexpr double margin_of_displacement = 1e-3;  // of a step's displacement: what bodies are kept apart for it
inline constexpr double margin_slack = 0.05;            // of the margin: what may be missing of it
inline constexpr double gap_share = 0.2;                // or of the gap within it: the same
inline constexpr double margin_decay = 0.5;             // [* -] a step leaves of the margin
inline constexpr double least_margin = 1e-10;           // of a radius: what slow bodies are kept apart
inline constexpr double parting_margin = 1e-3;          // of a radius: with a wider margin bodies part where they touch
inline constexpr double converged_displacement = 5e-4;  // of a radius: a group that moves less is not solved for again
inline constexpr std::uint8_t idle_steps = 8;           // without a force, then a body leaves the group
inline constexpr double resting_gap = 3e-8;             // of a radius: bodies at rest no farther apart may press
inline constexpr double rest_slack = 1e-13;             // of the greatest acceleration: of their forces
inline constexpr double balance = 1e-11;                // of gravity: forces whose sum is less hold a body
inline constexpr double standstill = 1e-5;              // of the speed of falling by a radius: as good as at rest
inline constexpr double jammed_speed = 1e-3;            // of the speed of falling by a radius: slower bodies stop
inline constexpr std::uint32_t many_short_steps = 8;    // ended at once by simultaneous impacts: a jam

}  // namespace carom::exact_tolerance

namespace carom::accuracy_tolerance {

// Which steps meet a tolerance (run/accuracy.h).
inline constexpr int most_instants = 64;              // of a run, at which two runs are compared,
inline constexpr double places_kept = 1e6;            // or fewer: of all bodies together
inline constexpr double golden = 0.6180339887498949;  // where in its part of a run an instant lies
inline constexpr double disturbance = 0x1p-50;        // of speeds and masses: rounding, of a finer run
inline constexpr double coarsest_error = 1e-6;        // of a radius and of speeds: a step's, so that its estimate holds
inline constexpr double finest_error = 0x1p-50;       // the same: rounding
inline constexpr double finer = 64;                   // step errors of two runs that are compared: one by the other
inline constexpr double first_share = 1e-3;           // of a tolerance: the first step error that is tried
inline constexpr double reference_share = 0.125;      // of a tolerance: to which the reference is known
inline constexpr double longest_choice = 64;          // of default_step (force.h): the first step that is tried
inline constexpr double gain = 0.75;                  // a halving leaves less of a difference,
inline constexpr int most_vain_halvings = 5;          // or so many do not: then none does
inline constexpr double most_steps = 3e7;             // of all bodies together, in the longest run,
inline constexpr double few_steps = 1e5;              // which is not begun where more seem needed after so many
inline constexpr double told_radius = 0.01;           // of the smallest radius: a tolerance where none is asked for
inline constexpr double carried_disturbance = 1e-12;  // of speeds and masses: whose growth tells chaos
inline constexpr double saturated = 0.01;             // of the largest radius: a disturbance is no longer small
inline constexpr std::size_t least_small = 8;         // instants at which it is: fewer tell no growth,
inline constexpr double clock_share = 1e-6;           // of the duration: unless it is all at once

}  // namespace carom::accuracy_tolerance

namespace carom::stepped_tolerance {

// The book simulator (book.h).
inline constexpr double frame_rounding = 1e-9;  // of a frame: a time as near to a frame's is that frame's

}  // namespace carom::stepped_tolerance
