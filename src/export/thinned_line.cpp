// Columns are closed as x advances, so that memory depends on their number alone.
#include "export/thinned_line.h"

#include "std.h"

namespace carom {

int interval_of(double x, double from, double to, int count) {
  const double share = (x - from) / (to - from);
  if (!(share > 0)) return 0;
  return share >= 1 ? count - 1 : min(int(share * count), count - 1);
}

void ThinnedLine::add(double x, double y) {
  const PlotPoint point{x, y};
  const int column = interval_of(x, from_, to_, columns);
  if (column != now_) {
    if (now_ >= 0) put(closed_, open_);
    open_ = {point, point, point, point};
    now_ = column;
    return;
  }
  if (y < open_.lowest.y) open_.lowest = point;
  if (y > open_.highest.y) open_.highest = point;
  open_.last = point;
}

vector<PlotPoint> ThinnedLine::points() const {
  vector<PlotPoint> points = closed_;
  if (now_ >= 0) put(points, open_);
  return points;
}

void ThinnedLine::put(vector<PlotPoint>& points, const Column& column) {
  const bool falls = column.highest.x < column.lowest.x;
  for (const PlotPoint& point :
       {column.first, falls ? column.highest : column.lowest, falls ? column.lowest : column.highest, column.last})
    if (points.empty() || points.back().x != point.x || points.back().y != point.y) points.push_back(point);
}

}  // namespace carom
