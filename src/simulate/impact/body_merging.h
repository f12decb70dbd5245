#pragma once
// Perfectly inelastic collisions: bodies that meet become one (chapter 8's two lumps of clay). The joint body keeps
// mass, momentum, volume and the centre of mass. It has the number and the shape of the heavier body, or of the first
// if both have the same mass. Where the joint volume overlaps a third body, that one merges too. Where it overlaps a
// fixed thing, it is moved out.

#include <initializer_list>

#include "physics/entity.h"

namespace carom {

struct Collision;
struct ExactBodies;
class FlatContacts;
class PathLog;
struct Touch;

class ExactGroup;
class FlightChanges;
class ModeChanges;

class BodyMerging {
 public:
  BodyMerging(ExactBodies& bodies, ModeChanges& modes, ExactGroup& group, FlatContacts& flat, FlightChanges& flights,
              PathLog& paths)
      : bodies_(bodies), modes_(modes), group_(group), flat_(flat), flights_(flights), paths_(paths) {}

  /// Merges bodies a and b, which touch as `there` describes.
  void merge(Entity a, Entity b, const Touch& there);

 private:
  void end_flight(Entity i);
  Collision meeting(Entity a, Entity b, const Touch& there) const;
  double join(Entity whole, Entity part);
  double potential(std::initializer_list<Entity> those) const;
  void go_on(Entity whole);
  void move_out(Entity whole);

  ExactBodies& bodies_;
  ModeChanges& modes_;
  ExactGroup& group_;
  FlatContacts& flat_;
  FlightChanges& flights_;
  PathLog& paths_;
};

}  // namespace carom
