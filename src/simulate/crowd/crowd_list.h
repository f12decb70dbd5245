#pragma once
// Which pairs of a crowd may press, where they are closest, and which other bodies a crowd may meet.

#include "geometry/touch.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/contact/numbering.h"
#include "simulate/crowd/crowd.h"
#include "simulate/crowd/crowd_kernels.h"
#include "simulate/crowd/crowd_threads.h"
#include "std.h"

namespace carom {

class CrowdList {
 public:
  /// `threads` must outlive the list.
  CrowdList(ExactBodies& bodies, Numbering::Numbers& numbers, CrowdThreads& threads)
      : bodies_(bodies), numbers_(numbers), threads_(threads) {}

  /// What a body of another kind, or of another crowd, may do to a crowd in some time to come.
  enum class Outlook : uint8_t {
    apart,       // it meets no member
    may_come,    // it is still far away, and may meet one
    may_strike,  // the same in the step to come
    joins        // it is near, and may meet one
  };

  /// Begins a list that holds for some steps. need: m, what a body may go in a step.
  void begin(Crowd& crowd, double need) const;
  /// Makes the regions of these members so wide that they hold while the list does. Returns the outsiders that
  /// are near.
  vector<Entity> hold_regions(const Crowd& crowd, span<const Entity> members);
  Outlook outlook(const Crowd& crowd, Entity e) const;
  /// Lists the pairs that may press while the list holds. Forces are those of the same pairs in the crowds `before`,
  /// which may be this one.
  void list(Crowd& crowd, span<const shared_ptr<Crowd>> before);
  /// The same for a part of the crowd that was listed last. No pair connects it to other parts.
  void list_part(Crowd& part);
  /// Measures gaps and normals. `seconds`: of the drift to come.
  void measure(Crowd& crowd, double seconds);

 private:
  double surface_skin(const Crowd& crowd) const;
  Outlook outlook_on(const Crowd& crowd, Entity member, Entity e) const;
  Touch closest(const Crowd& crowd, size_t k, Entity e, const Vec3& xe, const Vec3& moved) const;
  using Pairs = vector<CrowdRows::Pair>;
  void list_member(const Crowd& crowd, uint32_t k, double skin, Pairs& pairs) const;
  void take_over_forces(const Crowd& crowd, size_t members);
  uint32_t number_of(Crowd& crowd, Entity thing);
  void write(Crowd& crowd, const Pairs& pairs);

  ExactBodies& bodies_;
  const CrowdKernels& kernels_ = widest_crowd_kernels();
  Numbering::Numbers& numbers_;
  CrowdThreads& threads_;
  vector<uint32_t> thing_number_;  // by entity, while a part of the rows is written
  Pairs pairs_;                    // of the crowd that was listed last
  vector<uint8_t> seen_;           // by body, while near ones are found
};

}  // namespace carom
