#pragma once
// Passes a record from the thread that simulates to the one that draws. A bounded number of parts is on the way.
#include <condition_variable>
#include <deque>
#include <mutex>

#include "physics/recorded.h"
#include "simulate/simulator.h"
#include "std.h"

namespace carom {

/// Thrown to the reader of a record that will have no end.
struct RecordAbandoned {};

class RecordQueue {
 public:
  /// Adds what the simulator has recorded since its last advance. Waits while the queue is full, unless nobody reads.
  void put(const Simulator& simulator);
  /// Nothing more will come. whole: this is the end of the record.
  void end(bool whole);
  /// Nothing more will be read.
  void leave();
  /// Waits for the next part. False: the end. Throws RecordAbandoned after the last part of a record without an end.
  bool next(Recorded& recorded);

 private:
  using Batch = vector<Recorded>;
  void add_events(const vector<double>& fired, Batch& batch);
  enum class State { open, whole, abandoned };

  vector<double> fired_;  // of the writer: the events that have been added
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Batch> batches_;
  size_t parts_ = 0;  // in them
  State state_ = State::open;
  bool left_ = false;
  // Of the reader.
  Batch reading_;
  size_t read_ = 0;
};

}  // namespace carom
