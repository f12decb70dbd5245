#pragma once
// Which pairs of a crowd may press, where they are closest, and which other bodies a crowd may meet.
#include <memory>
#include <span>
#include <vector>

#include "geometry/touch.h"
#include "simulate/contact/exact_bodies.h"
#include "simulate/contact/numbering.h"
#include "simulate/crowd/crowd.h"
#include "simulate/crowd/crowd_kernels.h"

namespace carom {

class CrowdList {
 public:
  CrowdList(ExactBodies& bodies, Numbering::Numbers& numbers) : bodies_(bodies), numbers_(numbers) {}

  /// What a body of another kind, or of another crowd, may do to a crowd in some time to come.
  enum class Outlook : std::uint8_t {
    apart,       // it meets no member
    may_strike,  // it is still far away, and may strike one in the step to come
    joins        // it is near, and may meet one
  };

  /// Makes the region of each member so wide that it holds while the list does, and finds the bodies of other kinds
  /// that are near. need: m, what a body may go in a step.
  void hold_regions(Crowd& crowd, double need) const;
  Outlook outlook(const Crowd& crowd, Entity e, double seconds) const;
  /// Lists the pairs that may press while the list holds. Forces are those of the same pairs in the crowds `before`,
  /// which may be this one.
  void list(Crowd& crowd, std::span<const std::shared_ptr<Crowd>> before);
  /// Measures gaps and normals. `seconds`: of the drift to come.
  void measure(Crowd& crowd, double seconds) const;

 private:
  Outlook outlook_on(const Crowd& crowd, Entity member, Entity e, double seconds) const;
  Touch closest(const Crowd& crowd, std::size_t k, Entity e, const Vec3& xe, const Vec3& moved) const;
  std::uint32_t number_of(Crowd& crowd, Entity thing);
  void list_member(Crowd& crowd, std::uint32_t k, double skin);
  void take_over_forces(const Crowd& crowd, std::size_t members);

  ExactBodies& bodies_;
  const CrowdKernels& kernels_ = widest_crowd_kernels();
  Numbering::Numbers& numbers_;
  std::vector<std::uint32_t> thing_number_;  // by entity, while a crowd is listed
  std::vector<CrowdRows::Pair> pairs_;       // scratch
};

}  // namespace carom
