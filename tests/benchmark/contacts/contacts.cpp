// The contact solver alone, on a grid of problems: rows, stacks, lattices, packings, wedges and near copies. Masses
// span 0 to 12 decades; loads are gravity, pushes and impacts.
// Each case is one line of CSV:
// - the certificate
// - the error of the motion against quadruple precision, for few contacts and where that holds
// - CPU time cold, and warm after one pressing contact was removed and restored
// The last line has totals.
//
//    carom_contacts            all
//    carom_contacts FAMILY     small, medium, hard or large
#include <fmt/format.h>
#include <time.h>

#include "solver/contact_cases.h"
#include "solver/contact_problem.h"
#include "solver/contact_reference.h"
#include "std.h"

namespace carom::contact_cases {
namespace {

constexpr size_t most_for_reference = 330;  // contacts that press: its cost grows as their cube

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Totals {
  int cases = 0, unsolved = 0, compared = 0;
  double change = 0, error = 0;
};

double seconds_of(ContactSolver& solver, Case& c, Certificate& certificate) {
  const double begin = cpu_seconds();
  certificate = solver.solve({c.inverse_mass, c.motion, c.contacts});
  return cpu_seconds() - begin;
}

void measure(const string& family, const Case& given, Totals& totals) {
  constexpr const char* verdicts[] = {"solved", "infeasible", "doubtful"};
  ContactSolver solver;
  Certificate certificate, warm_certificate;
  Case c = given;
  const double cold = seconds_of(solver, c, certificate);

  // Against the reference, where that is affordable.
  const auto presses = [](const ContactConstraint& contact) { return contact.force > 0; };
  string error;
  if (static_cast<size_t>(ranges::count_if(c.contacts, presses)) <= most_for_reference) {
    const Reference exact = reference(given.inverse_mass, given.motion, c.contacts);
    if (exact.holds) {
      const double off = exact.error(given.motion, c.motion);
      error = fmt::format("{:.1e}", off);
      totals.error = std::max(totals.error, off);
      ++totals.compared;
    }
  }

  // Once more without one of the contacts that press, and with it again.
  string warm;
  const auto middle = static_cast<ptrdiff_t>(c.contacts.size() / 2);
  const auto away = std::find_if(c.contacts.begin() + middle, c.contacts.end(), presses);
  if (away != c.contacts.end()) {
    Case without = given, again = given;
    without.contacts.erase(without.contacts.begin() + (away - c.contacts.begin()));
    seconds_of(solver, without, warm_certificate);
    warm = fmt::format("{:.2e}", seconds_of(solver, again, warm_certificate));
    if (!warm_certificate.solved()) ++totals.unsolved;
  }

  fmt::print("{},\"{}\",{},{},{},{:.1e},{},{:.2e},{}\n", family, given.name, given.motion.size(), given.contacts.size(),
             verdicts[static_cast<int>(certificate.verdict)], certificate.change, error, cold, warm);
  ++totals.cases;
  totals.change = std::max(totals.change, certificate.change);
  if (!certificate.solved()) ++totals.unsolved;
}

void small(Totals& totals) {
  for (const Load load : loads)
    for (const double decades : {0.0, 3.0, 6.0, 9.0, 12.0}) {
      for (const int n : {2, 3, 10, 30}) {
        measure("small", loaded(fmt::format("row of {}", n), row(n), load, decades), totals);
        measure("small", loaded(fmt::format("stack of {}", n), stack(n), load, decades), totals);
      }
      measure("small", loaded("lattice of 4", lattice(1), load, decades), totals);
      measure("small", loaded("lattice of 32", lattice(2), load, decades), totals);
      measure("small", loaded("packing of 12", packing(12, 1), load, decades), totals);
      measure("small", loaded("packing of 50", packing(50, 1), load, decades), totals);
    }

  // Contacts that are nearly alike.
  for (int k = 2; k <= 12; ++k) {
    const double angle = pow(10.0, -k);
    for (const bool squeezed : {false, true}) measure("small", wedge(angle, squeezed), totals);
    measure("small", with_copies(loaded("packing of 12", packing(12, 1), Load::push, 3), angle), totals);
    measure("small", with_copies(loaded("lattice of 4", lattice(1), Load::push, 0), angle), totals);
    measure("small", with_copies(loaded("stack of 10", stack(10), Load::push, 0), angle), totals);
  }
}

void medium(Totals& totals) {
  for (const Load load : loads)
    for (const double decades : {0.0, 3.0, 6.0}) {
      for (const int n : {100, 300, 1000}) {
        measure("medium", loaded(fmt::format("row of {}", n), row(n), load, decades), totals);
        measure("medium", loaded(fmt::format("stack of {}", n), stack(n), load, decades), totals);
      }
      measure("medium", loaded("lattice of 108", lattice(3), load, decades), totals);
      measure("medium", loaded("lattice of 256", lattice(4), load, decades), totals);
      measure("medium", loaded("packing of 100", packing(100, 1), load, decades), totals);
      measure("medium", loaded("packing of 300", packing(300, 1), load, decades), totals);
    }
}

void hard(Totals& totals) {
  for (uint64_t seed = 1; seed <= 10; ++seed)
    for (const Load load : loads)
      for (const double decades : {6.0, 9.0, 12.0}) {
        measure("hard", loaded("lattice of 32", lattice(2), load, decades, seed), totals);
        measure("hard", loaded("lattice of 108", lattice(3), load, decades, seed), totals);
        measure("hard", loaded("packing of 60", packing(60, seed), load, decades, seed), totals);
      }
}

void large(Totals& totals) {
  for (const Load load : loads) {
    measure("large", loaded("lattice of 500", lattice(5), load, 0), totals);
    measure("large", loaded("lattice of 864", lattice(6), load, 0), totals);
    for (const double decades : {0.0, 6.0})
      measure("large", loaded("packing of 1000", packing(1000, 1), load, decades), totals);
    measure("large", loaded("packing of 2000", packing(2000, 1), load, 0), totals);
  }
}

int run(const string& family) {
  fmt::print("family,case,bodies,contacts,verdict,change,error,cold_s,warm_s\n");
  Totals totals;
  if (family.empty() || family == "small") small(totals);
  if (family.empty() || family == "medium") medium(totals);
  if (family.empty() || family == "hard") hard(totals);
  if (family.empty() || family == "large") large(totals);
  fmt::print(stderr,
             "{} cases, {} not solved cold or warm, change at most {:.1e}, error at most {:.1e} in {} compared\n",
             totals.cases, totals.unsolved, totals.change, totals.error, totals.compared);
  return totals.unsolved == 0 ? 0 : 1;
}

}  // namespace
}  // namespace carom::contact_cases

int main(int count, char** arguments) {
  return carom::contact_cases::run(count > 1 ? arguments[1] : "");
}
