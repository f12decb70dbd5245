#pragma once
// The parts of the simulator that an impact changes.

namespace carom {

struct ExactBodies;

class BodyMerging;
class CollapseDetector;
class ExactGroup;
class FlatContacts;
class FlightChanges;
class StallGuard;

struct ImpactParts {
  CollapseDetector& collapses;
  FlatContacts& flat;
  ExactGroup& group;
  FlightChanges& flights;
  BodyMerging& merging;
  StallGuard& guard;
};

}  // namespace carom
