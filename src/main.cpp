// carom: scenes of balls, walls and planes in; exact motion, data and pictures out.
#include "commands/interrupt.h"
#include "commands/program.h"
#include "commands/terminal.h"

int main(int argc, char** argv) {
  carom::hold_standard_descriptors();
  carom::catch_signals();
  return carom::run_program({argv + (argc > 0 ? 1 : 0), argv + argc}, carom::program_commit);
}
