#include "space/spatial.h"

namespace pintle {

// Eigen turns opposite vectors onto each other by singular values: compiled here alone, because that takes long.
Spatial::Frame Spatial::Frame::along(const Point& p, const Point& axis) {
  if (!(axis.norm() > 0)) return {p, Eigen::Matrix3d::Identity()};
  return {p, Eigen::Quaterniond::FromTwoVectors(Point::UnitZ(), axis).toRotationMatrix()};
}

}  // namespace pintle
