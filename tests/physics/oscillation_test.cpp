// Motion under springs, drag and constant forces, against values of mpmath (100 digits).
#include "physics/oscillation.h"

#include <gtest/gtest.h>

#include <random>

#include "physics/fading_path.h"
#include "std.h"

namespace carom {
namespace {

constexpr double unit_roundoff = 0x1p-53;
const Vec3 x0(1, -2, 3), v0(4, 0.5, -1), a0(-2, 3, 0.25);

struct ResponseReference {
  double fade, stiffness, t, displaced, kept, bent;
  double most_displaced, most_bent;  // in [0, t]
};

const ResponseReference response_references[] = {
    {0, 100, 0.01, 0.0099833416646828154378, 0.99500416527802576589, 4.9958347219742341123e-5, 0.00998334, 4.99583e-5},
    {0, 1, 3, 0.14112000805986722210, -0.98999249660044545727, 1.9899924966004454573, 1.0, 1.98999},
    {0, 2, 100000, -0.38671656632346696351, 0.83719806178823368942, 0.081400969105883155291, 0.707107, 1.0},
    {0, 10000, 10000000, 0.0054584344944869956424, 0.83788718136390233439, 1.6211281863609766561e-5, 0.01, 0.0002},
    {0, 1e-05, 0.001, 9.9999999999833335415e-4, 0.99999999999500000000, 4.9999999999958335415e-7, 0.001, 5.0e-7},
    {1e-05, 1e-05, 1, 0.99999333335916659563, 0.99998500008749968194, 0.49999791667263887577, 0.999993, 0.499998},
    {1e-05, 100000, 1000, 0.0030577327005390242305, 0.23468468160186850402, 7.6531528782080449059e-6, 0.00316228,
     2.0e-5},
    {0.1, 25, 4, 0.14943184403282413727, 0.32738504943685152325, 0.026306870646394642488, 0.196902, 0.0787628},
    {1, 10, 0.3, 0.22207150843166151314, 0.39885600961729995729, 0.037907248195103852957, 0.222072, 0.0379072},
    {2, 1, 0.001, 9.9900049983337501244e-4, 0.99800149933354161663, 4.9966679163334029738e-7, 0.000999, 4.99667e-7},
    {2, 1, 0.5, 0.30326532985631671180, 0.30326532985631671180, 0.090204010431049864594, 0.303265, 0.090204},
    {2, 1, 1.5, 0.33469524022264474340, -0.11156508007421491447, 0.44217459962892542767, 0.367879, 0.442175},
    {2, 1, 6, 0.014872513059998150538, -0.012393760883331792115, 0.98264873476333549104, 0.367879, 0.982649},
    {2, 1.0000000000000009, 1, 0.36787944117144226714, -1.0891419356660559978e-16, 0.26424111765711533994, 0.367879,
     0.264241},
    {2, 0.9999999999999991, 1, 0.36787944117144237605, 1.0891419356660561913e-16, 0.26424111765711537367, 0.367879,
     0.264241},
    {2.0000000000009095, 1, 3, 0.14936120510359182894, -0.099574136735659964346, 0.80085172652834046325, 0.367879,
     0.800852},
    {1.9999999999990905, 1, 3, 0.14936120510359182894, -0.099574136735795807571, 0.80085172652874799292, 0.367879,
     0.800852},
    {0.7012142388471159, 0.1229253521903306, 3.5776088982300225, 1.0205681902941732018, -0.072553029518889399885,
     2.9035188950897105511, 1.04926, 2.90352},
    {3, 1, 2, 0.20594634360551153809, -0.073343364806671735905, 0.45550433399013712164, 0.274933, 0.455504},
    {10, 1, 0.05, 0.039330609416530850050, 0.60562881348908417257, 0.0010650923456073269252, 0.0393306, 0.00106509},
    {10, 1, 0.5, 0.096311604814997084108, -0.0026424236524793095508, 0.039526375502508468474, 0.0963562, 0.0395264},
    {100, 1, 1, 0.0099024691269320891795, -9.9034595719436911403e-5, 0.0098521219025105189581, 0.00999179, 0.00985212},
    {100000, 1e-05, 1e-06, 9.5162581964040422583e-7, 0.90483741803595957258, 4.8374180359595727296e-13, 9.51626e-7,
     4.83742e-13},
    {100000, 1e-05, 1, 9.9999999990000200000e-6, -9.9999999990000308181e-16, 9.9998999995000199997e-6, 1.0e-5,
     9.9999e-6},
    {100000, 1e-05, 100000, 9.9999000005000183330e-6, -9.9999000005000291510e-16, 0.99999499991666862498, 1.0e-5,
     0.999995},
    {100000, 100000, 1, 3.6788312005782677813e-6, -3.6788679896260581988e-6, 6.3212055881016284793e-6, 9.99895e-6,
     6.32121e-6},
    {10000000000, 1000000000000, 1, 3.7200723303480929290e-54, -3.7200723675488169765e-52, 1.0000000000000000000e-12,
     1.0e-10, 1.0e-12},
    {10000000000, 1000000000000, 1e-05, 9.9900051980339558226e-11, -9.9900052979340098009e-9, 9.9949018660971567774e-16,
     1.0e-10, 9.9949e-16},
    {10000000000, 1000000000000, 1e-12, 9.9501662508302878687e-13, 0.99004983374867137464, 4.9833749168049421863e-25,
     9.95017e-13, 4.98337e-25},
    {0.5, 1e-20, 3, 1.5537396797031403421, 0.22313016014842982892, 2.8925206405937193157, 1.55374, 2.89252},
    {5, 1e-20, 3, 0.19999993881953589963, 3.0590232050182538837e-7, 0.56000001223609282007, 0.2, 0.56},
    {0.008677523689423554, 1.882484960857992e-05, 314.9994320643669, 80.307530588745805010, -0.093490208411777601198,
     2.1068944375951845093e+4, 84.789, 21068.9},
};

TEST(Oscillation, ResponseIsTheReferences) {
  for (const ResponseReference& r : response_references) {
    const Response of = response(r.fade, r.stiffness, r.t);
    const double allowed = 8 * unit_roundoff;  // 4.0, 1.9 and 6.9 at worst in 3e5 random cases
    EXPECT_NEAR(of.displaced, r.displaced, allowed * r.most_displaced) << r.fade << ' ' << r.stiffness << ' ' << r.t;
    EXPECT_NEAR(of.kept, r.kept, allowed) << r.fade << ' ' << r.stiffness << ' ' << r.t;
    EXPECT_NEAR(of.bent, r.bent, allowed * r.most_bent) << r.fade << ' ' << r.stiffness << ' ' << r.t;
  }
}

TEST(Oscillation, StartsWhereItIs) {
  Vec3 x, v;
  for (double fade : {0.0, 2.0, 5.0}) {
    Oscillation{x0, v0, a0, fade, 1}.at(0, x, v);
    EXPECT_EQ(x, x0);
    EXPECT_EQ(v, v0);
  }
}

TEST(Oscillation, KeepsItsAmplitudeForABillionRadians) {
  const double stiffness = 3;
  for (double t : {1.0, 1e3, 1e6, 577350269.0}) {
    Vec3 x, v;
    Oscillation{x0, v0, Vec3::Zero(), 0, stiffness}.at(t, x, v);
    const double before = v0.squaredNorm(), after = v.squaredNorm() + stiffness * (x - x0).squaredNorm();
    EXPECT_NEAR(after, before, 4 * unit_roundoff * before) << t;  // 1.9 at worst
  }
}

TEST(Oscillation, GoesOverIntoFadingFlight) {
  for (double fade : {0.0, 0.01, 0.7, 30.0}) {
    for (double t : {1e-3, 0.5, 20.0}) {
      const FadingPath path{x0, v0, a0 - fade * v0, fade};  // its a: at the start, drag and all
      Vec3 x, v;
      Oscillation{x0, v0, a0, fade, 1e-30}.at(t, x, v);
      const double size = (v0.norm() + a0.norm() * t) * t;
      EXPECT_LE((x - path.position(t)).norm(), x0.norm() * 4 * unit_roundoff + 4 * unit_roundoff * size)
          << fade << ' ' << t;
      EXPECT_LE((v - path.velocity(t)).norm(), 4 * unit_roundoff * (v0.norm() + a0.norm() * t)) << fade << ' ' << t;
    }
  }
}

TEST(Oscillation, IsContinuousThroughCriticalDamping) {
  for (double t : {1e-3, 0.3, 1.0, 2.0, 10.0}) {
    const Response critical = response(2, 1, t);
    for (double near : {1 - 0x1p-53, 1 + 0x1p-52}) {
      const Response r = response(2, near, t);
      EXPECT_NEAR(r.displaced, critical.displaced, 4 * unit_roundoff * t);  // 2.0 at worst
      EXPECT_NEAR(r.kept, critical.kept, 4 * unit_roundoff);
      EXPECT_NEAR(r.bent, critical.bent, 4 * unit_roundoff * critical.bent);
    }
  }
}

TEST(Oscillation, GoesOnFromAnyOfItsPlaces) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-2, 2);
  for (int n = 0; n < 2000; ++n) {
    const double fade = pow(10, exponent(random)), stiffness = pow(10, exponent(random));
    const double t1 = pow(10, exponent(random)), t2 = pow(10, exponent(random));
    Vec3 x, v, y, w, z, u;
    Oscillation{x0, v0, a0, fade, stiffness}.at(t1, x, v);
    // The springs have become slack or stretched on the way.
    Oscillation{x, v, a0 - stiffness * (x - x0), fade, stiffness}.at(t2, y, w);
    Oscillation{x0, v0, a0, fade, stiffness}.at(t1 + t2, z, u);
    const double reach = v0.norm() / sqrt(stiffness) + 2 * a0.norm() / stiffness;
    const double turned = sqrt(stiffness) * (t1 + t2) + 8;
    EXPECT_LE((y - z).norm(), unit_roundoff * (x0.norm() + turned * reach));  // 0.56 at worst
    EXPECT_LE((w - u).norm(), unit_roundoff * turned * sqrt(stiffness) * reach);
  }
}

TEST(Oscillation, HasTheSameBitsInOtherUnits) {
  const double length = 0x1p13, time = 0x1p-7;
  for (double fade : {0.0, 1.0, 2.0, 40.0}) {
    for (double t : {1e-3, 0.4, 1.7, 9.0}) {
      Vec3 x, v, y, w;
      Oscillation{x0, v0, a0, fade, 1.1}.at(t, x, v);
      Oscillation{length * x0, length / time * v0, length / (time * time) * a0, fade / time, 1.1 / (time * time)}.at(
          time * t, y, w);
      EXPECT_EQ(length * x, y);
      EXPECT_EQ(length / time * v, w);
    }
  }
}

}  // namespace
}  // namespace carom
