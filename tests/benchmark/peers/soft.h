#pragma once
// Contact as a damped spring, for peers without impacts.
#include <algorithm>
#include <cstddef>

namespace carom {

/// The number of steps that an undamped contact lasts: 16 among few bodies, 8 among many. With fewer, the restitution
/// depends more on where in a step a contact begins. With more, bodies overlap more.
inline double steps_of_contact(std::size_t bodies) {
  return bodies <= 10 ? 16 : 8;
}

struct SoftContact {
  double stiffness;  // 1/s^2: the overlap's acceleration by the overlap
  double damping;    // 1/s: the overlap's acceleration by its rate
};

/// The restitution of an impact at speed 1 in steps of length 1: v += a, x += v. It is the mean over the moments in a
/// step at which the impact begins. A contact that `pulls` does so while damping is stronger than the spring.
inline double restitution_of(const SoftContact& contact, bool pulls) {
  constexpr int phases = 32;
  double sum = 0;
  for (int k = 0; k < phases; ++k) {
    double overlap = (k + 0.5) / phases, rate = 1;
    while (overlap > 0) {
      const double push = contact.stiffness * overlap + contact.damping * rate;
      rate -= pulls ? push : std::max(push, 0.0);
      overlap += rate;
    }
    sum -= rate;
  }
  return sum / phases;
}

/// The spring that gives the restitution, 0.3 or more, in steps of `step` (s).
inline SoftContact contact_of(double restitution, bool pulls, double step, std::size_t bodies) {
  const double frequency = 3.14159265358979323846 / steps_of_contact(bodies), stiffness = frequency * frequency;
  double low = 0, high = frequency;
  for (int k = 0; k < 60; ++k) {
    const double middle = (low + high) / 2;
    (restitution_of({stiffness, middle}, pulls) > restitution ? low : high) = middle;
  }
  return {stiffness / (step * step), low / step};
}

}  // namespace carom
