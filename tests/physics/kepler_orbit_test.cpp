// Motion about a centre, against values of mpmath (100 digits, by the anomalies of each conic).
#include "physics/kepler_orbit.h"
#include "std.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>

namespace carom {
namespace {

constexpr double rounding = 0x1p-53, pi = std::numbers::pi;

struct Moving {
  Vec3 x, v;
};

Moving after(double mu, const Moving& start, double t) {
  Moving m;
  KeplerOrbit(mu, start.x, start.v).at(t, m.x, m.v);
  return m;
}

/// Change of the end by one unit in the last place of each input (m, m/s).
pair<double, double> last_place(double mu, const Moving& start, double t) {
  constexpr double many = 0x1p16;  // so that the orbit's own rounding does not count
  const Moving plain = after(mu, start, t);
  double x = 0, v = 0;

  for (int i = 0; i < 8; ++i) {
    double inputs[8] = {mu, start.x[0], start.x[1], start.x[2], start.v[0], start.v[1], start.v[2], t};
    inputs[i] *= 1 + many * 2 * rounding;
    const Moving m =
        after(inputs[0], {Vec3(inputs[1], inputs[2], inputs[3]), Vec3(inputs[4], inputs[5], inputs[6])}, inputs[7]);
    x += (m.x - plain.x).squaredNorm();
    v += (m.v - plain.v).squaredNorm();
  }
  return {sqrt(x) / many, sqrt(v) / many};
}

/// Orbits of every kind: strength, start and a time.
struct Case {
  double mu;
  Moving start;
  double t;
};
vector<Case> cases(int count) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  vector<Case> all;
  for (int n = 0; n < count; ++n) {
    const Vec3 x(any(random), any(random), any(random)), v(any(random), any(random), any(random));
    const double speed = pow(10, 1.5 * any(random));
    all.push_back({n % 4 == 0 ? -1.0 : 1.0, {x, speed * v}, pow(10, 2 * any(random))});
  }
  return all;
}

struct OrbitReference {
  double mu;
  Vec3 x, v;
  double t;
  Vec3 end_x, end_v;
  double last_x, last_v;  // what a last place of each input changes, and one of the result (m, m/s)
};

const OrbitReference orbit_references[] = {
    // clang-format off
  {1, {1, 0, 0}, {0, 1, 0}, 2,
   {-0.41614683654714238700, 0.90929742682568169540, 0},
   {-0.90929742682568169540, -0.41614683654714238700, 0}, 1.755e-15, 2.003e-15},
  {1, {1, 0, 0}, {0, 1, 0}, 62831.853071795864,
   {1.0000000000000000000, -9.7136470791369796784e-13, 0},
   {9.7136470791369796784e-13, 1.0000000000000000000, 0}, 6.584e-11, 6.584e-11},
  {1, {1, 0, 0}, {0, 1, 0}, 1000000,
   {0.93675212753314478694, -0.34999350217129295212, 0},
   {0.34999350217129295212, 0.93675212753314478694, 0}, 1.048e-9, 1.048e-9},
  {1, {1, 0, 0}, {0, 1.0000000000000284, 0}, 100.5,
   {0.99952062532808607623, -0.030959966791839901202, 0},
   {0.030959966791839020423, 0.99952062532811448432, 0}, 1.059e-13, 1.059e-13},
  {3, {1, 2, 2}, {0.6666, -0.6667, 0.3332}, 50,
   {-2.2126051772137882199, 0.49871272850652182095, -1.9631257087282423563},
   {-0.10746395838372145553, 0.92808860118799339128, 0.35660891905206621242}, 3.312e-14, 1.082e-14},
  {1, {1, 0, 0}, {0, 0.7, 0.2}, 3,
   {0.86070960813560285509, -0.35004208023007547885, -0.10001202292287872014},
   {0.53509061595679807796, 0.59566636974048496520, 0.17019039135442429602}, 1.668e-15, 2.108e-15},
  {1, {1, 0, 0}, {0.3, 0.7, 0.2}, 10000,
   {1.0425396515304825571, 0.29872943798462024894, 0.085351267995605795564},
   {-0.092294126985570230937, 0.64499132126933629856, 0.18428323464838182151}, 4.086e-12, 5.099e-12},
  {1, {0.01, 0, 0}, {0, 14, 0}, 1,
   {-0.42086183590362656576, 0.048326569410458635514, 0},
   {-0.81484297778279941712, -0.23908424497439134113, 0}, 1.651e-14, 1.489e-13},
  {1, {2, 0, 0}, {0, 0.0001, 0}, 3.14159,
   {3.2010656215436710544e-4, 5.0602396911386013137e-6, 0},
   {-79.030050459995632927, -0.62451390182358075287, 0}, 9.397e-14, 1.16e-8},
  {1, {2, 0, 0}, {0, 0.0001, 0}, 3,
   {0.42798471585256675485, 1.6404859516790161226e-4, 0},
   {-1.9165238505058476063, -2.6730638044717377495e-4, 0}, 2.369e-15, 6.916e-15},
  {1, {2, 0, 0}, {0, 0.0001, 0}, 1e-06,
   {1.9999999999998750000, 9.9999999999997916934e-11, 0},
   {-2.5000000000001040535e-7, 9.9999999999993754792e-5, 0}, 8.882e-16, 3.576e-20},
  {1, {2, 0, 0}, {0, 0.0001, 0}, 6.28,
   {1.9999987316519501982, -3.1854007540005335249e-7, 0},
   {7.9635069352504778795e-4, 9.9999936582557297009e-5, 0}, 8.865e-16, 5.943e-16},
  {1, {2, 0, 0}, {0, 0.0001, 0}, 31415.9,
   {1.9999088254345268370, -2.7006726432133152911e-6, 0},
   {0.0067519894128775310602, 9.9995441063896841687e-5, 0}, 7.847e-14, 2.904e-12},
  {1, {2, 0, 0}, {0, 1e-08, 0}, 3,
   {0.42798467676944732997, 1.6404858670399408548e-8, 0},
   {-1.9165240674301747224, -2.6730645010391023113e-8, 0}, 2.369e-15, 6.916e-15},
  {1, {2, 0, 0}, {0, 1e-08, 0}, 3.14159265,
   {3.8706477303073328242e-6, 5.5646313369713225920e-11, 0},
   {-718.82430591977786826, -0.0051670738280774916575, 0}, 8.547e-13, 7.936e-5},
  {1, {1e-08, 0, 0}, {0, 14142.135, 0}, 1,
   {-0.087276445515509539573, -2.8345136227420729409e-5, 0},
   {2.2965002468436267943, -8.7453994266240322369e-4, 0}, 1.513e-8, 8.487e-7},
  {1, {1e-08, 0, 0}, {0, 14142.135, 0}, 0.001,
   {-0.016022594514345942117, 2.3458960808047497455e-5, 0},
   {-10.352863392005370207, 0.0063314381745910878641, 0}, 2.114e-12, 2.855e-9},
  {1, {2, 0, 0}, {0, 1, 0}, 0.5,
   {1.9690697161110428355, 0.49743569545385192022, 0},
   {-0.12246498547978952652, 0.98477038619477875490, 0}, 9.346e-16, 4.493e-16},
  {1, {2, 0, 0}, {0, 1, 0}, 1000000,
   {-1.6503636486775446106e+4, 363.38009286999139195, 0},
   {-0.011006424001434169171, 1.2115604808733428844e-4, 0}, 1.484e-8, 1.978e-14},
  {1, {2, 0, 0}, {0, 1.0000000000000002, 0}, 1000,
   {-159.12078635994566430, 35.902176687209537503, 0},
   {-0.11004782863168345839, 0.012260853105421530262, 0}, 1.644e-12, 2.115e-15},
  {1, {2, 0, 0}, {0, 0.9999999999999999, 0}, 1000,
   {-159.12078635994406224, 35.902176687208383726, 0},
   {-0.11004782863168118410, 0.012260853105420346797, 0}, 1.171e-12, 1.501e-15},
  {1, {8, 6, 0}, {-0.4, -0.2, 0}, 17,
   {1.4941412791963501419, -0.99577659284673032164, 0},
   {1.0432221709742610705, -0.15983509880897625889, 0}, 5.529e-15, 1.792e-15},
  {1, {8, 6, 0}, {-0.36, -0.27, 1e-09}, 14.9,
   {0.17544638629927040478, 0.13158478972445301482, -7.6106024456006918446e-9},
   {2.4162245024961739816, 1.8121683768721321297, -5.9214238189532311775e-8}, 1.058e-14, 7.312e-14},
  {1, {-10, 1, 0}, {100, 0, 0}, 0.1,
   {2.0032467364770193699e-4, 0.99990993854684574333, 0},
   {100.00900496260910400, -0.0099523753292277244369, 0}, 2.896e-15, 3.642e-14},
  {1, {-10, 0.0001, 0}, {100, 0, 0}, 0.1,
   {9.6081133895513143210e-5, -0.0011794407403516728350, 0},
   {0.32917103357874449167, -108.11943309124036736, 0}, 2.881e-15, 1.904e-11},
  {1, {-10, 1e-08, 0}, {100, 0, 0}, 0.0999,
   {-0.0094045514760806691245, 9.9474905562011740547e-9, 0},
   {101.05673152302859307, -5.5939748740435003274e-7, 0}, 2.694e-15, 3.314e-13},
  {1, {-10, 1e-08, 0}, {100, 0, 0}, 1,
   {-90.001459180500241597, -0.018000122012823841890, 0},
   {-99.999109105414589767, -0.019999622022363100067, 0}, 4.641e-14, 3.642e-14},
  {1, {-10, 1e-08, 0}, {1, 0, 0}, 7,
   {-2.4690667914449982859, 9.1075645846598073461e-9, 0},
   {1.2688666753048705483, -6.3031312075234399522e-10, 0}, 3.503e-15, 7.833e-16},
  {1, {-10, 1e-08, 0}, {0.01, 0, 0}, 20,
   {-7.6070711182317896213, 7.7904201360449171061e-9, 0},
   {0.25102445601395338646, -2.4392909543379449895e-10, 0}, 4.552e-15, 1.995e-16},
  {1, {-10, 1, 0}, {0.01, 0, 0}, 40,
   {-4.6160471148145724636, 0.43867531050770232278, 0},
   {-0.47972879186402299148, 0.047756266616722024650, 0}, 6.863e-15, 6.806e-16},
  {1, {-1, 1, 0}, {2, 0, 0}, 1000000,
   {1.4010604545380476417e+6, -7.8919589456653027574e+5, 0},
   {1.4010563558621727042, -0.78919501333533881606, 0}, 1.16e-9, 1.138e-15},
  {1, {1, 0, 0}, {1000000, 100000000, 0}, 1e-07,
   {1.0999999999999990925, 9.9999999999999988554, 0},
   {9.9999999999999005996e+5, 9.9999999999999991093e+7, 0}, 4.239e-15, 3.711e-8},
  {-1, {-10, 1, 0}, {1, 0, 0}, 10,
   {-1.5432847339553720305, 1.4205928783939630218, 0},
   {0.42224816018783145888, 0.25928933392390109822, 0}, 2.539e-15, 8.283e-16},
  {-1, {-10, 1e-08, 0}, {100, 0, 0}, 0.2,
   {-9.9979586487476443399, 0.0019996017456631437810, 0},
   {-99.999997795803223066, 0.020000199759162438477, 0}, 6.572e-15, 3.642e-14},
  {-1, {-10, 1e-08, 0}, {0.01, 0, 0}, 3,
   {-10.015022479754364836, 1.0045067520210976611e-8, 0},
   {-0.019999973057822301850, 3.0044972976995805888e-11, 0}, 3.984e-15, 1.654e-17},
  {-1, {1, 1, 1}, {0, 0, 0}, 1000000,
   {6.2039637719788822253e+5, 6.2039637719788822253e+5, 6.2039637719788822253e+5},
   {0.62040273939566774680, 0.62040273939566774680, 0.62040273939566774680}, 4.874e-10, 4.537e-16},
  {-1e-06, {1, 0, 0}, {-1, 0, 0.001}, 2,
   {-0.99998279831479561253, 0, 0.0039999563948755800486},
   {-0.99999600000679817093, 0, 0.0029999919999951925108}, 7.659e-16, 3.331e-16},
  {1, {1, 0, 0}, {0, 0, 0}, 1,
   {0.35068159507509943245, 0, 0},
   {-1.9243646380809675927, 0, 0}, 9.41e-16, 4.039e-15},
  {1, {3, 4, 0}, {-0.75, -1, 0}, 1.5,
   {1.8382936666026447782, 2.4510582221368597043, 0},
   {-0.80839380109229263568, -1.0778584014563901809, 0}, 1.755e-15, 4.669e-16},
  {398600.4418, {7000, -1200, 300}, {1.1, 7.2, 0.5}, 864000,
   {-721.10408647791313343, -6822.2857784744500483, -456.62979884847343661},
   {7.4555833865954882834, -1.1869014577071583847, 0.32511470468043030883}, 3.745e-9, 4.177e-12},
    // clang-format on
};

TEST(KeplerOrbit, IsTheReferences) {
  for (const OrbitReference& r : orbit_references) {  // 0.5 and 1.0 at worst
    const Moving end = after(r.mu, {r.x, r.v}, r.t);
    EXPECT_LE((end.x - r.end_x).norm(), 2 * r.last_x) << r.x.transpose() << ", " << r.v.transpose() << ", " << r.t;
    EXPECT_LE((end.v - r.end_v).norm(), 2 * r.last_v) << r.x.transpose() << ", " << r.v.transpose() << ", " << r.t;
  }
}

TEST(KeplerOrbit, StartsWhereItIs) {
  for (const Case& c : cases(100)) {
    const Moving m = after(c.mu, c.start, 0), next = after(c.mu, c.start, 1e-300);
    EXPECT_EQ(m.x, c.start.x);
    EXPECT_EQ(m.v, c.start.v);
    EXPECT_LE((next.x - m.x).norm(), 8 * rounding * m.x.norm());                           // 3.5 at worst
    EXPECT_LE((next.v - m.v).norm(), 8 * rounding * (m.v.norm() + sqrt(2 / m.x.norm())));  // 3.3
  }
}

TEST(KeplerOrbit, KeepsEnergyAndAngularMomentum) {
  for (const Case& c : cases(2000)) {
    const Moving m = after(c.mu, c.start, c.t);
    const auto energy = [&](const Moving& of) { return 0.5 * of.v.squaredNorm() - c.mu / of.x.norm(); };
    const auto size = [&](const Moving& of) { return of.v.squaredNorm() + std::abs(c.mu) / of.x.norm(); };
    EXPECT_LE(std::abs(energy(m) - energy(c.start)), 8 * rounding * std::max(size(m), size(c.start)));  // 5.4
    const double arm = std::max(m.x.norm() * m.v.norm(), c.start.x.norm() * c.start.v.norm());
    EXPECT_LE((m.x.cross(m.v) - c.start.x.cross(c.start.v)).norm(), 12 * rounding * arm);  // 8.2
  }
}

TEST(KeplerOrbit, StaysOnItsOrbitBeyondCountableTurns) {
  const Vec3 x(1, 0, 0), v(0, 0.8, 0.1);
  for (double t : {1e15, 1e20, 1e40, 1e290}) {
    const Moving m = after(1, {x, v}, t);
    EXPECT_NEAR(m.v.squaredNorm() - 2 / m.x.norm(), v.squaredNorm() - 2, 12 * rounding);  // 6 at worst
    EXPECT_LE((m.x.cross(m.v) - x.cross(v)).norm(), 4 * rounding);                        // 1
  }
}

TEST(KeplerOrbit, GoesOnFromAnyOfItsPlaces) {
  for (const Case& c : cases(2000)) {
    const double t1 = 0.75 * c.t, t2 = c.t - t1;
    const Moving half = after(c.mu, c.start, t1), end = after(c.mu, half, t2), whole = after(c.mu, c.start, t1 + t2);
    const auto [first_x, first_v] = last_place(c.mu, c.start, c.t);
    const auto [second_x, second_v] = last_place(c.mu, half, t2);
    EXPECT_LE((end.x - whole.x).norm(), 4 * (first_x + second_x + rounding * whole.x.norm()));  // 2.3
    EXPECT_LE((end.v - whole.v).norm(), 4 * (first_v + second_v + rounding * whole.v.norm()));  // 2.3
  }
}

TEST(KeplerOrbit, ComesBackWhenReversed) {
  for (const Case& c : cases(2000)) {
    const Moving there = after(c.mu, c.start, c.t), turned = {there.x, -there.v}, back = after(c.mu, turned, c.t);
    const auto [x, v] = last_place(c.mu, turned, c.t);
    EXPECT_LE((back.x - c.start.x).norm(), 4 * (x + rounding * back.x.norm()));  // 2.5
    EXPECT_LE((back.v + c.start.v).norm(), 4 * (v + rounding * back.v.norm()));  // 2.5
  }
}

TEST(KeplerOrbit, ClosesAfterAPeriod) {
  for (double speed : {1.0, 0.5, 0.01, 1.4}) {
    const Moving start = {Vec3(1, 0, 0), Vec3(0, speed, 0)};
    const KeplerOrbit orbit(1, start.x, start.v);
    const double a = 1 / (2 - speed * speed);
    EXPECT_NEAR(orbit.period(), 2 * pi * a * sqrt(a), 6 * rounding * orbit.period());  // 2.6
    for (double turns : {1, 4, 1024}) {
      Moving m;
      orbit.at(turns * orbit.period(), m.x, m.v);
      EXPECT_LE((m.x - start.x).norm(), rounding * (4 + turns * orbit.period() * speed)) << speed;  // 0.7 of it
    }
  }
}

TEST(KeplerOrbit, OfACircleTurnsAtAConstantSpeed) {
  const KeplerOrbit orbit(4, Vec3(0, 1, 0), Vec3(0, 0, 2));
  EXPECT_DOUBLE_EQ(orbit.pericentre(), 1);
  EXPECT_EQ(orbit.closest_time(), 0);
  for (int n = 1; n <= 400; ++n) {
    Moving m;
    orbit.at(0.25 * n, m.x, m.v);
    EXPECT_LE((m.x - Vec3(0, std::cos(0.5 * n), std::sin(0.5 * n))).norm(), 4 * rounding) << n;       // 2.0
    EXPECT_LE((m.v - 2 * Vec3(0, -std::sin(0.5 * n), std::cos(0.5 * n))).norm(), 8 * rounding) << n;  // 4.1
  }
}

TEST(KeplerOrbit, IsClosestAtItsPericentre) {
  for (const Case& c : cases(1000)) {
    const KeplerOrbit orbit(c.mu, c.start.x, c.start.v);
    const double t = orbit.closest_time();
    if (!(t < INFINITY)) {
      EXPECT_GE(c.start.x.dot(c.start.v), 0) << "it leaves, and is not bound";
      EXPECT_EQ(orbit.period(), INFINITY);
      continue;
    }

    Moving m;
    orbit.at(t, m.x, m.v);

    const auto [x, v] = last_place(c.mu, c.start, t);
    EXPECT_NEAR(m.x.norm(), orbit.pericentre(), 8 * rounding * orbit.pericentre() + x);
    EXPECT_LE(std::abs(m.x.dot(m.v)), 16 * rounding * m.x.norm() * m.v.norm() + x * m.v.norm() + v * m.x.norm());
  }
}

TEST(KeplerOrbit, FallsFromRestInTheTimeOfTheClosedForm) {
  const KeplerOrbit orbit(2, Vec3(0, 0, 3), Vec3::Zero());
  const double fall = pi * sqrt(27.0 / 16);  // pi sqrt(r^3 / (8 mu))
  EXPECT_NEAR(orbit.closest_time(), fall, 4 * rounding * fall);
  EXPECT_EQ(orbit.pericentre(), 0);
  Moving m;
  const double t = 0x1p-30;
  orbit.at(t, m.x, m.v);
  EXPECT_NEAR(m.v.z(), -2.0 / 9 * t, 4 * rounding * t) << "no digits are lost at the top";
}

TEST(KeplerOrbit, HasTheSameBitsInOtherUnits) {
  const double length = 0x1p13, time = 0x1p-7;
  for (const Case& c : cases(2000)) {
    const Moving m = after(c.mu, c.start, c.t);
    const Moving scaled = after(c.mu * length * length * length / (time * time),
                                {length * c.start.x, length / time * c.start.v}, time * c.t);
    EXPECT_EQ(length * m.x, scaled.x);
    EXPECT_EQ(length / time * m.v, scaled.v);
  }
}

TEST(KeplerOrbit, HasTheSameBitsInAMirror) {
  for (const Case& c : cases(500)) {
    const auto mirror = [](const Vec3& of) { return Vec3(of.x(), -of.y(), of.z()); };
    const Moving m = after(c.mu, c.start, c.t), mirrored = after(c.mu, {mirror(c.start.x), mirror(c.start.v)}, c.t);
    EXPECT_EQ(mirror(m.x), mirrored.x);
    EXPECT_EQ(mirror(m.v), mirrored.v);
  }
}

}  // namespace
}  // namespace carom
