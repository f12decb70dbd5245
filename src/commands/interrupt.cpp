// The handler stores the signal, and nothing else: few functions may be called in a handler. SA_RESETHAND lets a second
// signal end the program.
#include "commands/interrupt.h"

#include <csignal>
#include <initializer_list>

#include "export/child.h"
#include "render/mesh.h"
#include "workbook/workbook_files.h"

namespace carom {

namespace {

volatile std::sig_atomic_t received = 0;

void record_signal(int signal) {
  received = signal;
}

}  // namespace

void catch_signals() {
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  struct sigaction action {};
  action.sa_handler = record_signal;
  action.sa_flags = int(SA_RESETHAND | SA_RESTART);
  sigemptyset(&action.sa_mask);

  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    // A signal ignored by the parent (nohup, a background job of a plain shell) stays ignored.
    if (sigaction(signal, nullptr, &before) == 0 && before.sa_handler == SIG_IGN) continue;
    sigaction(signal, &action, nullptr);
  }
  check_while_waiting(stop_if_interrupted);
  check_while_reading(stop_if_interrupted);
  check_while_packing(stop_if_interrupted);
}

void stop_if_interrupted() {
  if (received != 0) throw Interrupted{received};
}

}  // namespace carom
