#pragma once
// When contacts of a cluster end on its path: where a contact force turns to zero, or where a surface does.
#include "simulate/stepped_cluster_motion.h"
#include "simulate/stepped_events.h"
#include "simulate/stepped_shared.h"

namespace carom {

/// Schedules the ends of a cluster's active contacts; its paths lead to the step's end.
void predict_releases(const StepShared& shared, const ClusterMotion& motion, const Cluster& cluster,
                      StepEvents& events);

}  // namespace carom
