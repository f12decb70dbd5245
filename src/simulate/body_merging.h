#pragma once
// Perfectly inelastic collisions: bodies that meet become one (chapter 8's two lumps of clay). The joint body keeps
// mass, momentum, volume and the centre of mass; it goes by the name of the heavier of the two (of the first, if they
// weigh the same) and has its shape. Where the joint volume reaches into a third body, the two have met as well; where
// it reaches into something fixed, it is moved out.

#include "physics/entity.h"
namespace carom {

struct ExactBodies;
class FlatContacts;
class PathLog;
struct Touch;

class EventPredictor;
class EventQueue;
class FlightChanges;

class BodyMerging {
 public:
  BodyMerging(ExactBodies& bodies, FlatContacts& flat, FlightChanges& flights, EventQueue& queue,
              EventPredictor& predictor, PathLog& paths)
      : bodies_(bodies), flat_(flat), flights_(flights), queue_(queue), predictor_(predictor), paths_(paths) {}

  /// Bodies a and b, which touch like this now, become one.
  void merge(Entity a, Entity b, const Touch& there);

 private:
  void record(Entity a, Entity b, const Touch& there);
  void join(Entity whole, Entity part);
  void move_out(Entity whole);

  ExactBodies& bodies_;
  FlatContacts& flat_;
  FlightChanges& flights_;
  EventQueue& queue_;
  EventPredictor& predictor_;
  PathLog& paths_;
};

}  // namespace carom
