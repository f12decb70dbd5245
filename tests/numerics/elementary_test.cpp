// Elementary functions, against values of mpmath (100 digits).
#include "numerics/elementary.h"

#include <gtest/gtest.h>

#include "std.h"

namespace carom {
namespace {

/// Units in the last place of `expected`.
double ulps(double value, double expected) {
  if (value == expected) return 0;
  int exponent;
  std::frexp(expected, &exponent);
  return std::abs(value - expected) / std::ldexp(1.0, std::max(exponent - 53, -1074));
}

constexpr double allowed = 2.5;  // 2.4 at worst in 4e5 random arguments, by arc_sinh

struct SinCosReference {
  double z, sin, cos;
};

const SinCosReference sin_cos_references[] = {
    {1e-300, 1.0000000000000000251e-300, 1.0000000000000000000},
    {1e-08, 1.0000000000000000043e-8, 0.99999999999999995000},
    {0.1, 0.099833416646828157830, 0.99500416527802576554},
    {0.7853981633974483, 0.70710678118654750275, 0.70710678118654754605},
    {1, 0.84147098480789650665, 0.54030230586813971740},
    {1.5707963267948966, 1.0000000000000000000, 6.1232339957367658861e-17},
    {-2.5, -0.59847214410395649405, -0.80114361554693371483},
    {3.141592653589793, 1.2246467991473531772e-16, -1.0000000000000000000},
    {22, -0.0088513092904038759217, -0.99996082639463712645},
    {355, -3.0144353359488449214e-5, -0.99999999954565898017},
    {-1000, -0.82687954053200256026, 0.56237907629070299108},
    {100000, 0.035748797972016509316, -0.99936080743821245189},
    {573204, 0.99999999999995681434, -2.9388998644070330805e-7},
    {10000000, 0.42054779319078249130, -0.90727038618173956116},
    {123456789.125, 0.99987638542726281883, 0.015723036122574079692},
    {1000000000, 0.54584344944869956424, 0.83788718136390233439},
    {-1521577112.6973875, 0.98074466519399483090, 0.19529439749649497836},
    {1000000000000000.0, 0.85827279317023583552, -0.51319373778697025223},
};

TEST(SinCos, AreTheReferences) {
  for (const SinCosReference& r : sin_cos_references) {
    const SinCos of = sin_cos(r.z), mirrored = sin_cos(-r.z);
    EXPECT_LE(ulps(of.sin, r.sin), 1) << r.z;
    EXPECT_LE(ulps(of.cos, r.cos), 1) << r.z;
    EXPECT_EQ(mirrored.sin, -of.sin);
    EXPECT_EQ(mirrored.cos, of.cos);
  }
}

TEST(SinCos, TakeInWhatADoubleLacks) {
  const SinCos of = sin_cos(DoubleDouble{1e9, 1e-8});
  const SinCos plain = sin_cos(1e9);
  EXPECT_NEAR(of.sin, plain.sin + 1e-8 * plain.cos, 2e-16);
  EXPECT_NEAR(of.cos, plain.cos - 1e-8 * plain.sin, 2e-16);
}

TEST(SinCos, AreNumbersForAnyArgument) {
  for (double z : {0x1p51, 1e17, 1e300, infinity, infinity - infinity}) {
    const SinCos of = sin_cos(z);
    EXPECT_NEAR(of.sin * of.sin + of.cos * of.cos, 1, 4e-16) << z;
  }
}

struct ExponentialReference {
  double z, left, gone;
};

const ExponentialReference exponential_references[] = {
    {1e-300, 1.0000000000000000000, 1.0000000000000000251e-300},
    {1e-17, 0.99999999999999999000, 1.0000000000000000665e-17},
    {1e-05, 0.99999000004999983333, 9.9999500001666670680e-6},
    {0.1, 0.90483741803595956814, 0.095162581964040431859},
    {0.3, 0.74081822068171787429, 0.25918177931828212571},
    {0.34657359027997264, 0.70710678118654753260, 0.29289321881345246740},
    {0.37, 0.69073433063735466262, 0.30926566936264533738},
    {0.6931471805599453, 0.50000000000000001160, 0.49999999999999998840},
    {1, 0.36787944117144232160, 0.63212055882855767840},
    {1.1, 0.33287108369807952372, 0.66712891630192047628},
    {4.46582, 0.011495265776289040251, 0.98850473422371095975},
    {10, 4.5399929762484851536e-5, 0.99995460007023751515},
    {36.5, 1.4068617124461467672e-16, 0.99999999999999985931},
    {100, 3.7200759760208359630e-44, 1.0000000000000000000},
    {500.25, 5.5486256846221690900e-218, 1.0000000000000000000},
    {700, 9.8596765437597708567e-305, 1.0000000000000000000},
};

TEST(Exponential, IsTheReferences) {
  for (const ExponentialReference& r : exponential_references) {
    EXPECT_LE(ulps(exp_minus(r.z), r.left), allowed) << r.z;
    EXPECT_LE(ulps(exp_loss(r.z), r.gone), allowed) << r.z;
  }
}

TEST(Exponential, GrowsAsTheReferences) {
  const pair<double, double> references[] = {
      {1e-17, 1.00000000000000001},        {0.1, 1.1051709180756476309},
      {0.3, 1.349858807576003089},         {0.34657359027997264, 1.4142135623730950324},
      {0.37, 1.4477346146633244552},       {1, 2.7182818284590452354},
      {1.1, 3.0041660239464333789},        {4.46582, 86.99233401481431863},
      {36.5, 7108019154642244.0649},       {100, 2.6881171418161354484e+43},
      {500.25, 1.802248082388160778e+217}, {709.5, 1.3549863193146328309e+308},
  };

  for (const auto& [z, value] : references) EXPECT_LE(ulps(exponential(z), value), allowed) << z;
  EXPECT_EQ(exponential(0), 1);
  EXPECT_EQ(exponential(-1.1), exp_minus(1.1));
  EXPECT_EQ(exponential(710), infinity);
  EXPECT_EQ(exponential(-infinity), 0);
  EXPECT_TRUE(std::isnan(exponential(infinity - infinity)));
}

TEST(Exponential, EndsAtTheLeastDouble) {
  EXPECT_EQ(exp_minus(0), 1);
  EXPECT_EQ(exp_minus(744.5), 0x1p-1074);
  EXPECT_EQ(exp_minus(1e300), 0);
  EXPECT_EQ(exp_minus(INFINITY), 0);
  EXPECT_EQ(exp_loss(0), 0);
  EXPECT_EQ(exp_loss(INFINITY), 1);
}

struct LogarithmReference {
  double y, log, arc_sinh;
};

const LogarithmReference logarithm_references[] = {
    {1e-300, 1.0000000000000000251e-300, 1.0000000000000000251e-300},
    {1e-17, 1.0000000000000000665e-17, 1.0000000000000000715e-17},
    {1e-08, 9.9999999500000005426e-9, 1.0000000000000000043e-8},
    {0.01, 0.0099503308531680830543, 0.0099998333408328871433},
    {0.1, 0.095310179804324865090, 0.099834078899207568851},
    {0.41, 0.34358970439007689286, 0.39930400105592392217},
    {0.416341, 0.34807678548827636378, 0.40516447534729724181},
    {0.5, 0.40546510810816438198, 0.48121182505960344750},
    {1, 0.69314718055994530942, 0.88137358701954302523},
    {1.5, 0.91629073187415506518, 1.1947632172871093041},
    {3, 1.3862943611198906188, 1.8184464592320668235},
    {10, 2.3978952727983705441, 2.9982229502979697388},
    {100000, 11.512935464920228753, 12.206072645555173730},
    {1e+100, 230.25850929940456842, 230.95165647996451373},
    {1e+300, 690.77552789821370526, 691.46867507877365057},
};

TEST(Logarithm, IsTheReferences) {
  for (const LogarithmReference& r : logarithm_references) {
    EXPECT_LE(ulps(log_one_plus(r.y), r.log), allowed) << r.y;
    EXPECT_LE(ulps(arc_sinh(r.y), r.arc_sinh), allowed) << r.y;
    EXPECT_EQ(arc_sinh(-r.y), -arc_sinh(r.y));
  }
}

TEST(Logarithm, OfAnyPositiveDoubleIsTheReference) {
  const pair<double, double> references[] = {
      {5e-324, -744.44007192138126231},
      {1e-310, -713.8013788281541651},
      {1e-300, -690.77552789821370518},
      {0.001, -6.9077552789821370312},
      {0.5, -0.69314718055994530942},
      // Near 1.
      {0.99, -0.010050335853501450155},
      {0.9999999999999999, -1.1102230246251566021e-16},
      {1.0000000000000002, 2.2204460492503128343e-16},
      {1.01, 0.0099503308531680916421},
      // Above it.
      {2, 0.69314718055994530942},
      {10, 2.302585092994045684},
      {123456.789, 11.723646487185881016},
      {1e+300, 690.77552789821370526},
      {1.7976931348623157e+308, 709.78271289338399673},
  };

  for (const auto& [x, value] : references) EXPECT_LE(ulps(logarithm(x), value), allowed) << x;
  EXPECT_EQ(logarithm(1), 0);
}

struct AngleReference {
  double y, x, angle;
};

const AngleReference angle_references[] = {
    {0, 1, 0},
    {1e-300, 2, 5.0000000000000001253e-301},
    {1e-08, 1, 9.9999999999999998759e-9},
    {0.1, 1, 0.099668652491162032875},
    {0.5, 1, 0.46364760900080611621},
    {1, 1, 0.78539816339744830962},
    {1, 0.3, 1.2793395323170295374},
    {1, 0, 1.5707963267948966192},
    {1, -1e-09, 1.5707963277948966192},
    {2, -1.5, 2.2142974355881810060},
    {1, -100000, 3.1415826535897935718},
    {0, -1, 3.1415926535897932385},
    {-0.05658, 1, -0.056519739255120868539},
    {-3, 4, -0.64350110879328438680},
    {-1, -1, -2.3561944901923449288},
    {-1e-09, -1, -3.1415926525897932385},
    {-5, 1e-200, -1.5707963267948966192},
};

TEST(Angle, IsTheReferences) {
  for (const AngleReference& r : angle_references) {
    const double angle = arc_tangent(r.y, r.x);
    EXPECT_LE(ulps(angle, r.angle), allowed) << r.y << ' ' << r.x;
    EXPECT_EQ(arc_tangent(0x1p-20 * r.y, 0x1p-20 * r.x), angle) << "of any unit";
  }
  EXPECT_EQ(arc_tangent(0, 0), 0);
}

TEST(TwoDoubles, QuotientAndRootUndoTheProduct) {
  const DoubleDouble a = {3, 0x1p-54}, b = {7, -0x1p-52};
  EXPECT_LE(std::abs(((a / b) * b - a).value()), 0x1p-102);
  const DoubleDouble root = square_root(a);
  EXPECT_LE(std::abs((root * root - a).value()), 0x1p-102);
  EXPECT_EQ(square_root({0, 0}).value(), 0);
}

}  // namespace
}  // namespace carom
