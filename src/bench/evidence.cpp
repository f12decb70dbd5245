// The agreement of two runs by halved steps does not show what both have missed.
// Closed forms do not prove that the code which uses them is correct.
// Therefore no method's own estimate is accepted where another method contradicts it.
// See Oberkampf & Roy, Verification and Validation in Scientific Computing, 2010,
// ch. 5 and 7: code and solution verification.
#include "bench/evidence.h"

#include "physics/world.h"
#include "std.h"

namespace carom {

namespace {

/// An estimate of an error may be wrong by this factor.
constexpr double safety = 10;
/// The same for the effect of rounding, which is estimated from a few runs.
constexpr double rounding_room = 16;
/// The ratio of successive changes that counts as convergence. A method of order 1 halves its error with its step.
constexpr double converging = 0.6;

/// In units of a position's last digit: 2^-7 of the extent. A run with a larger error is no evidence.
constexpr double largest_error = 0x1p46;

/// Whether steps are as short as forces require, or there are none.
bool resolves_forces(const SimulationMethod& method) {
  return method.engine == Engine::exact || method.is_stepped_by(Integrator::dop853);
}

}  // namespace

Evidence::Evidence(const World& world, const vector<double>& instants, double until, const Differences& rounding,
                   double last_digit, Finding first)
    : world_(world), instants_(instants), until_(until), rounding_(rounding), last_digit_(last_digit) {
  findings_.push_back(std::move(first));
}

void Evidence::add(Finding finding) {
  findings_.push_back(std::move(finding));
}

void Evidence::add_halved(const SimulationMethod& method, RecordedRun run) {
  if (run.hash == findings_.front().run.hash) return;

  if (last_ && last_->method.integrator != method.integrator) {
    last_.reset();
    best_ = 0;
  }

  Finding finding{method, std::move(run), {}};
  double change = infinity;
  if (last_) {
    finding.error = larger(between(last_->run, finding.run), rounding_);
    // A position is rounded in each step, often in the same direction.
    change = max(finding.error.position, until_ / *method.steps.length * last_digit_);
    const bool falls = change_ < infinity && change <= converging * change_;
    // Two successive runs may have the same error by accident, but three hardly do.
    finding.error.position = change_ < infinity ? max(change, 0.5 * change_) : change;
    const bool converges = falls || change <= rounding_room * rounding_.position;
    if (converges && finding.error.position <= largest_error * last_digit_) keep(finding);
  }

  last_ = std::move(finding);
  change_ = change;
}

/// Keeps the best run of the series so far.
void Evidence::keep(const Finding& finding) {
  if (best_ == 0) {
    best_ = findings_.size();
    findings_.push_back(finding);
  } else if (finding.error.position < findings_[best_].error.position) {
    findings_[best_] = finding;
  }
}

bool Evidence::agree(const Finding& a, const Finding& b, double apart) const {
  return apart <= safety * (a.error.position + b.error.position) + rounding_room * rounding_.position;
}

Verdict Evidence::verdict(bool settled) const {
  const size_t n = findings_.size();
  Verdict verdict;

  vector<Differences> apart(n * n);
  vector<bool> confirmed(n);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = i + 1; j < n; ++j) {
      apart[i * n + j] = apart[j * n + i] = between(findings_[i].run, findings_[j].run);
      // Two methods of fixed steps may agree because neither resolves what happens between its steps.
      if (resolves_forces(findings_[i].method) || resolves_forces(findings_[j].method))
        if (agree(findings_[i], findings_[j], apart[i * n + j].position)) confirmed[i] = confirmed[j] = true;
    }

  // The first finding is the reference unless others confirm a different one, or confirm one with far smaller error.
  for (size_t i = 1; i < n && !settled; ++i) {
    const double mine = findings_[i].error.position, held = findings_[verdict.reference].error.position;
    if (confirmed[i] && (!confirmed[verdict.reference] || rounding_room * mine < held)) verdict.reference = i;
  }

  const Finding& reference = findings_[verdict.reference];
  verdict.error = reference.error;

  // How far each of the others is from it.
  Differences least{infinity, infinity, infinity, 0, 0};
  for (size_t i = 0; i < n; ++i) {
    if (i == verdict.reference) continue;
    const Differences& d = apart[verdict.reference * n + i];
    verdict.witnesses.push_back({findings_[i].method, d.position, agree(reference, findings_[i], d.position)});
    if (d.position < least.position) least = d;
  }

  if (n > 1 && !confirmed[verdict.reference]) verdict.error = larger(verdict.error, least);
  return verdict;
}

}  // namespace carom
