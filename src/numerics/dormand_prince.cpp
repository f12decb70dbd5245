// The embedded Runge-Kutta method DOP853, of order 8 (Hairer, Norsett & Wanner, Solving Ordinary Differential Equations
// I, 2nd ed. 1993, II.5 and II.6). The coefficients are those of their program, zeros left out. Velocities and
// accelerations of all points advance together as one system of first order. The dense output costs three more stages.
// They are evaluated only when interpolate() is called.
#include "numerics/dormand_prince.h"

#include "std.h"

namespace carom {

namespace {

/// One term of a stage: a weight and the number of the earlier stage that it applies to.
struct Weight {
  size_t stage;
  double value;
};
using StageWeights = vector<Weight>;

const StageWeights stage_of[] = {
    {},
    {{0, 0.05260015195876773}},                                                                 // 1
    {{0, 0.0197250569845379}, {1, 0.0591751709536137}},                                         // 2
    {{0, 0.02958758547680685}, {2, 0.08876275643042054}},                                       // 3
    {{0, 0.2413651341592667}, {2, -0.8845494793282861}, {3, 0.924834003261792}},                // 4
    {{0, 0.037037037037037035}, {3, 0.17082860872947386}, {4, 0.12546768756682242}},            // 5
    {{0, 0.037109375}, {3, 0.17025221101954405}, {4, 0.06021653898045596}, {5, -0.017578125}},  // 6
    {{0, 0.03709200011850479},
     {3, 0.17038392571223998},
     {4, 0.10726203044637328},
     {5, -0.015319437748624402},
     {6, 0.008273789163814023}},  // 7
    {{0, 0.6241109587160757},
     {3, -3.3608926294469414},
     {4, -0.868219346841726},
     {5, 27.59209969944671},
     {6, 20.154067550477894},
     {7, -43.48988418106996}},  // 8
    {{0, 0.47766253643826434},
     {3, -2.4881146199716677},
     {4, -0.590290826836843},
     {5, 21.230051448181193},
     {6, 15.279233632882423},
     {7, -33.28821096898486},
     {8, -0.020331201708508627}},  // 9
    {{0, -0.9371424300859873},
     {3, 5.186372428844064},
     {4, 1.0914373489967295},
     {5, -8.149787010746927},
     {6, -18.52006565999696},
     {7, 22.739487099350505},
     {8, 2.4936055526796523},
     {9, -3.0467644718982196}},  // 10
    {{0, 2.273310147516538},
     {3, -10.53449546673725},
     {4, -2.0008720582248625},
     {5, -17.9589318631188},
     {6, 27.94888452941996},
     {7, -2.8589982771350235},
     {8, -8.87285693353063},
     {9, 12.360567175794303},
     {10, 0.6433927460157636}},  // 11
    {{0, 0.054293734116568765},
     {5, 4.450312892752409},
     {6, 1.8915178993145003},
     {7, -5.801203960010585},
     {8, 0.3111643669578199},
     {9, -0.1521609496625161},
     {10, 0.20136540080403034},
     {11, 0.04471061572777259}},  // 12
    {{0, 0.056167502283047954},
     {6, 0.25350021021662483},
     {7, -0.2462390374708025},
     {8, -0.12419142326381637},
     {9, 0.15329179827876568},
     {10, 0.00820105229563469},
     {11, 0.007567897660545699},
     {12, -0.008298}},  // 13
    {{0, 0.03183464816350214},
     {5, 0.028300909672366776},
     {6, 0.053541988307438566},
     {7, -0.05492374857139099},
     {10, -0.00010834732869724932},
     {11, 0.0003825710908356584},
     {12, -0.00034046500868740456},
     {13, 0.1413124436746325}},  // 14
    {{0, -0.42889630158379194},
     {5, -4.697621415361164},
     {6, 7.683421196062599},
     {7, 4.06898981839711},
     {8, 0.3567271874552811},
     {12, -0.0013990241651590145},
     {13, 2.9475147891527724},
     {14, -9.15095847217987}},  // 15
};
const StageWeights error_5 = {{0, 0.01312004499419488},  {5, -1.2251564463762044},   {6, -0.4957589496572502},
                              {7, 1.6643771824549864},   {8, -0.35032884874997366},  {9, 0.3341791187130175},
                              {10, 0.08192320648511571}, {11, -0.022355307863886294}};
const StageWeights error_3 = {{0, -0.18980075407240762}, {5, 4.450312892752409},   {6, 1.8915178993145003},
                              {7, -5.801203960010585},   {8, -0.4226823213237919}, {9, -0.1521609496625161},
                              {10, 0.20136540080403034}, {11, 0.02265179219836082}};
const StageWeights dense[] = {
    {{0, -8.428938276109013},
     {5, 0.5667149535193777},
     {6, -3.0689499459498917},
     {7, 2.38466765651207},
     {8, 2.117034582445028},
     {9, -0.871391583777973},
     {10, 2.2404374302607883},
     {11, 0.6315787787694688},
     {12, -0.08899033645133331},
     {13, 18.148505520854727},
     {14, -9.194632392478356},
     {15, -4.436036387594894}},
    {{0, 10.427508642579134},
     {5, 242.28349177525817},
     {6, 165.20045171727028},
     {7, -374.5467547226902},
     {8, -22.113666853125306},
     {9, 7.733432668472264},
     {10, -30.674084731089398},
     {11, -9.332130526430229},
     {12, 15.697238121770845},
     {13, -31.139403219565178},
     {14, -9.35292435884448},
     {15, 35.81684148639408}},
    {{0, 19.985053242002433},
     {5, -387.0373087493518},
     {6, -189.17813819516758},
     {7, 527.8081592054236},
     {8, -11.57390253995963},
     {9, 6.8812326946963},
     {10, -1.0006050966910838},
     {11, 0.7777137798053443},
     {12, -2.778205752353508},
     {13, -60.19669523126412},
     {14, 84.32040550667716},
     {15, 11.99229113618279}},
    {{0, -25.69393346270375},
     {5, -154.18974869023643},
     {6, -231.5293791760455},
     {7, 357.6391179106141},
     {8, 93.40532418362432},
     {9, -37.45832313645163},
     {10, 104.0996495089623},
     {11, 29.8402934266605},
     {12, -43.53345659001114},
     {13, 96.32455395918828},
     {14, -39.17726167561544},
     {15, -149.72683625798564}},
};

// The stage at the step's end. It is also the first of the next step.
constexpr size_t last = 12;

Vec3 sum(const StageWeights& row, const vector<Vec3>* stages, size_t k) {
  Vec3 s = Vec3::Zero();
  for (const Weight& w : row) s += w.value * stages[w.stage][k];
  return s;
}

/// The error estimate h e_5^2 / sqrt(e_5^2 + e_3^2 / 100), of order 8 (Hairer, Norsett & Wanner, II.10, eq. 10.17).
double error_of(double h, double e5, double e3) {
  if (e5 == 0) return 0;
  const double ratio = 0.1 * e3 / e5;
  return h * std::abs(e5) / sqrt(1 + ratio * ratio);
}

}  // namespace

DormandPrince::DormandPrince(vector<Vec3> x, vector<Vec3> v, vector<Vec3> a) : DenseMotion(std::move(x), std::move(v)) {
  velocity_[0] = v_;
  rate_[0] = std::move(a);
}

void DormandPrince::evaluate(size_t stage, const Acceleration& acceleration) {
  vector<Vec3> x(x_);
  vector<Vec3>& v = velocity_[stage];
  v.resize(x.size());
  for (size_t k = 0; k < x.size(); ++k) {
    x[k] += length_ * sum(stage_of[stage], velocity_, k);
    v[k] = v_[k] + length_ * sum(stage_of[stage], rate_, k);
  }
  rate_[stage] = acceleration(x, v);
}

void DormandPrince::evaluate_all(double h, const Acceleration& acceleration) {
  length_ = h;
  for (size_t stage = 1; stage <= last; ++stage) evaluate(stage, acceleration);
}

double DormandPrince::step(double h, const Acceleration& acceleration, double position, double velocity) {
  evaluate_all(h, acceleration);
  return greatest_error([&](size_t) { return position; }, [&](size_t) { return velocity; });
}

double DormandPrince::step(double h, const Acceleration& acceleration, span<const double> position,
                           span<const double> velocity) {
  evaluate_all(h, acceleration);
  return greatest_error([&](size_t k) { return position[k]; }, [&](size_t k) { return velocity[k]; });
}

/// The greatest error of a point along an axis, as a share of position(k) (m) and velocity(k) (m/s).
template <typename Position, typename Velocity>
double DormandPrince::greatest_error(Position position, Velocity velocity) const {
  const double h = length_;
  double greatest = 0;
  for (size_t k = 0; k < size(); ++k) {
    const Vec3 x5 = sum(error_5, velocity_, k), x3 = sum(error_3, velocity_, k);
    const Vec3 v5 = sum(error_5, rate_, k), v3 = sum(error_3, rate_, k);
    for (int axis = 0; axis < 3; ++axis) {
      const double x_error = error_of(h, x5[axis], x3[axis]) / position(k);
      const double v_error = error_of(h, v5[axis], v3[axis]) / velocity(k);
      if (!isfinite(x_error) || !isfinite(v_error)) return infinity;
      greatest = max({greatest, x_error, v_error});
    }
  }

  return greatest;
}

double DormandPrince::next_length(double h, double error) {
  constexpr double safety = 0.9, shortest = 0.2, longest = 6;
  if (!isfinite(error)) return shortest * h;
  const double eighth_root = sqrt(sqrt(sqrt(error)));
  return h * (eighth_root > 0 ? clamp(safety / eighth_root, shortest, longest) : longest);
}

void DormandPrince::interpolate(const Acceleration& acceleration) {
  for (size_t stage = last + 1; stage < stages; ++stage) evaluate(stage, acceleration);

  const auto coefficients = [&](const vector<Vec3>* rates, vector<Vec3>& c) {
    c.clear();
    for (size_t k = 0; k < size(); ++k) {
      const Vec3 change = length_ * sum(stage_of[last], rates, k);
      c.push_back(change);
      c.push_back(length_ * rates[0][k] - change);
      c.push_back(2 * change - length_ * (rates[last][k] + rates[0][k]));
      for (const StageWeights& row : dense) c.push_back(length_ * sum(row, rates, k));
    }
  };

  coefficients(velocity_, of_displacement_);
  coefficients(rate_, of_velocity_);
}

/// c0 s + c1 s (1 - s) + c2 s^2 (1 - s) + ...
Vec3 DormandPrince::polynomial(const vector<Vec3>& coefficients, size_t k, double s) {
  Vec3 y = Vec3::Zero();
  for (size_t term = terms; term-- > 0;) {
    y += coefficients[terms * k + term];
    y *= term % 2 == 0 ? s : 1 - s;
  }
  return y;
}

Vec3 DormandPrince::displacement(size_t k, double t) const {
  return polynomial(of_displacement_, k, t / length_);
}

Vec3 DormandPrince::velocity(size_t k, double t) const {
  return v_[k] + polynomial(of_velocity_, k, t / length_);
}

PolynomialPath DormandPrince::path(size_t k) const {
  // The velocity's polynomial in powers of s. A factor s moves every coefficient up by one power.
  // A factor 1 - s makes each coefficient itself less the one of the power below.
  array<Vec3, terms> change;
  change.fill(Vec3::Zero());
  for (size_t term = terms; term-- > 0;) {
    change[0] += of_velocity_[terms * k + term];
    if (term == 0) break;
    for (size_t power = terms - 1; power > 0; --power)
      change[power] = term % 2 == 0 ? change[power - 1] : Vec3(change[power] - change[power - 1]);
    if (term % 2 == 0) change[0].setZero();
  }

  // Its integral is the path.
  PolynomialPath path;
  path.length = length_;
  path.displacement[0] = length_ * v_[k];
  for (size_t power = 0; power < terms; ++power)
    path.displacement[power + 1] = length_ / double(power + 2) * change[power];
  return path;
}

}  // namespace carom
