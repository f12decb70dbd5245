#pragma once
// What the entries of flights.bin so far say of the next one, so that only the rest is stored.
//
// All predictions are + - * / and square roots of doubles, in the order of path_codec.cpp: both sides must have the
// same bits. Another program that reads the file computes them, too.

#include "export/flight_columns.h"
#include "physics/recorded.h"
#include "std.h"

namespace carom {

struct World;

/// An impact of two bodies, as far as their paths before it give it.
struct PredictedImpact {
  Entity other = no_entity;
  Vec3 v = Vec3::Zero();        // m/s, before
  Vec3 other_v = Vec3::Zero();  // m/s, before
  Vec3 normal = Vec3::Zero();   // unit, to the other one
  double approach = 0;          // m/s
  double mass = 0;              // kg
  double other_mass = 0;        // kg
  double restitution = 0;

  double impulse() const;    // N s
  Vec3 after() const;        // m/s
  Vec3 other_after() const;  // m/s
};

/// Writes entries to columns, or reads them from there. A reader needs the entries before, or the present pieces of all
/// bodies.
class PathCodec {
 public:
  /// For a run in this world. impulses: collisions have theirs.
  explicit PathCodec(const World& world, bool impulses = false);

  /// Begins a block at `time` (s). Nothing but the present pieces is known from before.
  void begin_block(double time);
  /// `next`: the piece after it, if it is known. `world`: gives the restitution of the two.
  void write(ColumnWriter& to, const PathPiece& piece, const PathPiece* next, const World& world);
  void write(ColumnWriter& to, const CollisionMark& collision);
  /// The next entry. Bodies are below the number of bodies. False: it is damaged.
  bool read(ColumnReader& from, Recorded& recorded);

  /// The present pieces, by body; of no body: there was none yet.
  const vector<PathPiece>& present() const { return present_; }
  double from() const { return from_; }  // s, of the piece before

  void keep(auto& archive) {
    archive.sized(present_, mass_, radius_);
    archive(body_, from_, start_, until_, collision_, restitution_, last_mass_, last_radius_, struck_, struck_v_);
  }

 private:
  template <typename Columns>
  struct Side;

  template <typename Columns>
  void code(Side<Columns>& side, PathPiece& piece, PredictedImpact& impact);
  template <typename Columns>
  void code_time(Side<Columns>& side, PathPiece& piece, Entity other) const;
  template <typename Columns>
  void code_place(Side<Columns>& side, PathPiece& piece) const;
  template <typename Columns>
  void code_step(Side<Columns>& side, const PathPiece& piece, PolynomialPath& curve) const;
  template <typename Columns>
  void code_velocity(Side<Columns>& side, PathPiece& piece, PredictedImpact& impact, const Vec3& ahead);
  template <typename Columns>
  void code_kick(Side<Columns>& side, PathPiece& piece) const;
  template <typename Columns>
  void code_rest(Side<Columns>& side, PathPiece& piece, int64_t traits);
  template <typename Columns>
  void code_curve(Side<Columns>& side, PathPiece& piece, PolynomialPath& curve) const;
  template <typename Columns>
  void code_size(Side<Columns>& side, Entity body);

  double contact_time(const PathPiece& a, const PathPiece& b, const DoubleDouble& since) const;
  double usual_from(const PathPiece& piece) const;
  Vec3 next_velocity(const PathPiece& piece) const;
  void predict_impact(const PathPiece& piece, PredictedImpact& impact) const;
  PredictedImpact impact_between(const PathPiece& piece, const PathPiece* next, const World& world) const;

  size_t entities_;  // bodies and all that they meet
  bool impulses_;
  vector<PathPiece> present_;
  vector<double> mass_;    // kg, by body
  vector<double> radius_;  // m, by body
  // Of the entries before, in the same block.
  Entity body_ = no_entity;
  double from_ = 0;           // s
  DoubleDouble start_{0, 0};  // s
  DoubleDouble until_{0, 0};  // s, of a kicked piece
  CollisionMark collision_;
  double restitution_ = 0;        // of an impact
  double last_mass_ = 0;          // kg, of a body whose first piece it was
  double last_radius_ = 0;        // m
  Entity struck_ = no_entity;     // the other body of the impact that the entry before began with
  Vec3 struck_v_ = Vec3::Zero();  // m/s, after it
};

}  // namespace carom
