// A body that lies just on the cut between two slabs is in neither: it goes with the rows between them. Mirror images
// would have it on the other side.
#include "simulate/crowd/crowd_slabs.h"

#include <numeric>
#include <tuple>

#include "simulate/tolerances.h"
#include "std.h"

namespace carom {

namespace tol = exact_tolerance;

namespace {

/// Coordinates of all members along the axis on which they are farthest apart, and that distance (m).
struct AxisCoordinates {
  vector<double> at;
  double extent = 0;
};

AxisCoordinates widest(const Crowd& crowd) {
  int axis = 0;
  double extent = -1;
  for (int k = 0; k < 3; ++k) {
    double least = never;
    double most = -never;
    for (size_t i = 0; i < crowd.members.size(); ++i) {
      least = min(least, crowd.x[i].at[k]);
      most = max(most, crowd.x[i].at[k]);
    }
    if (!(most - least > extent)) continue;
    axis = k;
    extent = most - least;
  }

  AxisCoordinates spread{{}, extent};
  for (size_t i = 0; i < crowd.members.size(); ++i) spread.at.push_back(crowd.x[i].at[axis]);
  return spread;
}

double median_radius(const Crowd& crowd) {
  vector<double> radii;
  for (size_t k = 0; k < crowd.members.size(); ++k) radii.push_back(crowd.x[k].at[3]);
  const auto middle = radii.begin() + ptrdiff_t(radii.size() / 2);
  std::nth_element(radii.begin(), middle, radii.end());
  return *middle;
}

/// An even number, or 1.
size_t count_of_slabs(const Crowd& crowd, double extent, double beyond_radii) {
  const size_t by_members = crowd.members.size() / tol::members_of_slab;
  if (by_members < 2) return 1;
  const double thinnest = tol::rows_through_slab * (2 * median_radius(crowd) + beyond_radii);
  const double by_extent = min(extent / thinnest, double(by_members));
  return max<size_t>(2 * size_t(by_extent / 2), 1);
}

/// The coordinates between `count` slabs with as many members each.
vector<double> cuts_between(vector<double> at, size_t count) {
  vector<double> cuts;
  const size_t n = at.size();
  ranges::sort(at);
  for (size_t k = 1; k < count; ++k) {
    const size_t rank = 2 * k <= count ? k * n / count : n - (count - k) * n / count;
    // The middle one of an odd number of members is on the cut.
    const size_t before = 2 * k == count ? (n - 1) / 2 : rank - 1;
    cuts.push_back(0.5 * (at[before] + at[rank]));
  }
  return cuts;
}

/// 2 s in slab s, 2 s + 1 on the cut behind it. Of equal cuts it is the one nearest to the middle.
uint32_t place_at(double coordinate, const vector<double>& cuts) {
  const auto [first, last] = std::equal_range(cuts.begin(), cuts.end(), coordinate);
  if (first == last) return uint32_t(2 * (first - cuts.begin()));
  const auto cut = clamp(cuts.begin() + ptrdiff_t(cuts.size() / 2), first, last - 1);
  return uint32_t(2 * (cut - cuts.begin()) + 1);
}

template <typename T>
void reorder(vector<T>& values, span<const uint32_t> order) {
  vector<T> in_order;
  in_order.reserve(values.size());
  for (const uint32_t k : order) in_order.push_back(values[k]);
  values = std::move(in_order);
}

/// The part of a pair's rows, by the places of its bodies.
size_t part_of(size_t a, size_t b, size_t slabs) {
  if (a > b) std::swap(a, b);
  if (a == b && a % 2 == 0) return a / 2;
  // Between neighbours there is one cut. Those with even numbers come first.
  const size_t cut = a / 2;
  if (cut != (b - 1) / 2) return 2 * slabs - 1;
  return slabs + (cut % 2 == 0 ? 0 : slabs / 2) + cut / 2;
}

}  // namespace

void arrange_in_slabs(Crowd& crowd, double beyond_radii) {
  CrowdRows& rows = crowd.rows;
  const size_t n = crowd.members.size();
  const AxisCoordinates spread = widest(crowd);
  const size_t count = count_of_slabs(crowd, spread.extent, beyond_radii);

  // Places are slabs and the gaps between them, in turn.
  vector<uint32_t> place(n, 0);
  vector<uint32_t> next(2 * count + 1, 0);  // number of the next member with a place
  const vector<double> cuts = cuts_between(spread.at, count);
  for (size_t k = 0; k < n; ++k) {
    place[k] = place_at(spread.at[k], cuts);
    ++next[place[k] + 1];
  }

  std::partial_sum(next.begin(), next.end(), next.begin());
  rows.first.clear();
  for (size_t slab = 0; slab <= count; ++slab) rows.first.push_back(next[2 * slab]);

  // Members in the order of their names stay in this order in each place.
  vector<uint32_t> order(n);
  for (uint32_t& k : crowd.by_name) {
    const uint32_t number = next[place[k]]++;
    order[number] = exchange(k, number);
  }

  // All data of members follow.
  crowd.x.resize(n);
  crowd.v.resize(n);
  reorder(crowd.members, order);
  reorder(crowd.x, order);
  reorder(crowd.v, order);
  reorder(crowd.a, order);
  reorder(crowd.lag, order);
  reorder(crowd.lent, order);
  reorder(crowd.idle, order);
  reorder(crowd.pressed, order);
  reorder(crowd.still, order);
  reorder(place, order);
  rows.place = std::move(place);
}

vector<vector<CrowdRows::Pair>> pairs_of_parts(const CrowdRows& rows, span<const CrowdRows::Pair> pairs) {
  const size_t slabs = rows.first.size() - 1;
  vector<vector<CrowdRows::Pair>> of_part(slabs == 1 ? 1 : 2 * slabs);
  for (const CrowdRows::Pair& pair : pairs) {
    const uint32_t a = rows.place[pair.a];
    const uint32_t b = pair.b < rows.place.size() ? rows.place[pair.b] : a;
    of_part[part_of(a, b, slabs)].push_back(pair);
  }

  const auto before = [](const CrowdRows::Pair& left, const CrowdRows::Pair& right) {
    return std::tuple(left.name.a, left.name.e) < std::tuple(right.name.a, right.name.e);
  };
  for (vector<CrowdRows::Pair>& part : of_part)
    if (!std::is_sorted(part.begin(), part.end(), before)) ranges::sort(part, before);
  return of_part;
}

}  // namespace carom
