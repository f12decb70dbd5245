#pragma once
// Lasting contact as it is reported.
#include "physics/entity.h"

namespace carom {

/// Two things that press on each other in lasting contact.
struct ContactForce {
  Entity a;      // the body with the lower number, or the only one
  Entity b;      // the other body, the fixed thing or the string
  double force;  // N, along the normal, > 0; in a string its tension; of a rod that pushes below 0
};

}  // namespace carom
