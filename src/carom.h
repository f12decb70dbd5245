#pragma once
// What other programs include: find_package(carom), the target carom::carom, #include <carom/carom.h>. What is named
// here is public, and may change with the second number of the version. Other headers are there for these alone.

#include "engine/accuracy.h"     // settle_steps: those that meet a scene's tolerance
#include "engine/engine.h"       // make_simulator
#include "physics/collision.h"   // Collision, as recorded
#include "physics/energy.h"      // of a State
#include "physics/state.h"       // State: positions and velocities
#include "physics/world.h"       // World: masses, volumes, forces
#include "scene/load.h"          // load_scene, and SceneError, which has all errors of a file
#include "scene/scene.h"         // Scene: World, first State, and names in Roster
#include "simulate/simulator.h"  // Simulator
