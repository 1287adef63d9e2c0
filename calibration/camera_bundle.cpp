#include "calibration/camera_calibration.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <utility>

#include "anatomy/base/error.h"
#include "anatomy/geometry/dense_solvers.h"
#include "calibration/rotation.h"

namespace palpa::calibration {
namespace {

/// From the board to the picture.
Mat3 homographyOf(const BoardView& view, const std::string& where) {
  std::vector<cv::Point2d> board, picture;
  for (const Vec3& p : view.p_W) board.emplace_back(p.x(), p.y());
  for (const Eigen::Vector2d& p : view.pixels) picture.emplace_back(p.x(), p.y());
  const cv::Mat found = cv::findHomography(board, picture, cv::LMEDS);
  if (found.empty() || !cv::checkRange(found))
    throw Error("the corners of the view " + view.name + " are no picture of the board", where,
                "Leave it out");
  Mat3 H;
  for (int i = 0; i < 9; ++i) H(i / 3, i % 3) = found.at<double>(i / 3, i % 3);
  return H;
}

/// With the picture's origin shifted to the centre, columns g, h of a homography fulfil g' w h = 0
/// and g' w g = h' w h for w = diag(1/fx^2, 1/fy^2, 1): least squares of the two.
void findFocalLengths(const std::vector<Mat3>& homographies, CameraModel* model) {
  Mat3 shift = Mat3::Identity();
  shift(0, 2) = -model->cx;
  shift(1, 2) = -model->cy;
  Eigen::Matrix2d A = Eigen::Matrix2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  for (const Mat3& H : homographies) {
    Mat3 G = shift * H;
    G /= G.topLeftCorner<2, 2>().norm() / model->width;  // of like size in all views
    const Vec3 gh = G.col(0).cwiseProduct(G.col(1)),
               difference = G.col(0).cwiseAbs2() - G.col(1).cwiseAbs2();
    for (const Vec3& row : {gh, difference}) {
      A += row.head<2>() * row.head<2>().transpose();
      b -= row.head<2>() * row.z();
    }
  }
  const Eigen::Vector2d w = minimumNorm(A, b);
  const double usual = std::max(model->width, model->height);
  const auto focal = [&](double inverse_square) {
    return inverse_square > 0 ? std::clamp(1 / std::sqrt(inverse_square), 0.3 * usual, 20 * usual)
                              : usual;
  };
  model->fx = focal(w[0]);
  model->fy = focal(w[1]);
}

Pose poseOf(const Mat3& H, const CameraModel& m) {
  Mat3 K;
  K << m.fx, 0, m.cx, 0, m.fy, m.cy, 0, 0, 1;
  Mat3 B = K.inverse() * H;
  B *= 2 / (B.col(0).norm() + B.col(1).norm());
  if (B(2, 2) < 0) B = -B;
  Mat3 R;
  R << B.col(0), B.col(1), B.col(0).cross(B.col(1));
  return makePose(nearestRotation(R), B.col(2));
}

class BundleFit {
 public:
  BundleFit(const std::vector<BoardView>& views, int lens_numbers, CameraBundle* bundle)
      : views_(views), lens_(lens_numbers), bundle_(*bundle) {
    for (const BoardView& view : views_) corners_ += static_cast<int>(view.pixels.size());
  }

  Fit run(bool keep_all, const std::string& where) {
    const FitProblem problem{corners_,
                             2,
                             lens_ + 6 * static_cast<int>(views_.size()),
                             [this](const VectorX& dx) { return residuals(dx); },
                             [this](const VectorX& dx) { bundle_ = at(dx); },
                             [this] { return jacobian(); },
                             keep_all};
    return robustFit(problem, where,
                     1);  // how many may be wrong is decided where views are left out
  }

 private:
  CameraBundle at(const VectorX& dx) const {
    CameraBundle b = bundle_;
    CameraModel& m = b.model;
    std::array<double*, kLensNumbers> numbers{&m.fx, &m.fy, &m.cx, &m.cy};
    for (std::size_t k = 0; k < 5; ++k) numbers[4 + k] = &m.distortion[k];
    for (int k = 0; k < lens_; ++k) *numbers[static_cast<std::size_t>(k)] += dx[k];
    for (std::size_t v = 0; v < b.X_CW.size(); ++v)
      b.X_CW[v] = moved(b.X_CW[v], dx.segment<6>(lens_ + 6 * static_cast<Eigen::Index>(v)));
    return b;
  }

  VectorX residuals(const VectorX& dx) const {
    const CameraBundle b = at(dx);
    VectorX r(2 * corners_);
    Eigen::Index row = 0;
    for (std::size_t v = 0; v < views_.size(); ++v)
      for (std::size_t i = 0; i < views_[v].pixels.size(); ++i, row += 2)
        r.segment<2>(row) = b.model.project(b.X_CW[v] * views_[v].p_W[i]) - views_[v].pixels[i];
    return r;
  }

  MatrixX jacobian() const {
    MatrixX J = MatrixX::Zero(2 * corners_, lens_ + 6 * static_cast<Eigen::Index>(views_.size()));
    Eigen::Index row = 0;
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Pose& X_CW = bundle_.X_CW[v];
      const Eigen::Index pose = lens_ + 6 * static_cast<Eigen::Index>(v);
      for (const Vec3& p_W : views_[v].p_W) {
        const Vec3 p_C = X_CW * p_W;
        Eigen::Matrix<double, 2, 3> by_point;
        bundle_.model.project(p_C, &by_point);
        J.block(row, 0, 2, lens_) = bundle_.model.byLens(p_C).leftCols(lens_);
        J.block<2, 3>(row, pose) = -by_point * X_CW.linear() * crossMatrix(p_W);
        J.block<2, 3>(row, pose + 3) = by_point;
        row += 2;
      }
    }
    return J;
  }

  const std::vector<BoardView>& views_;
  int lens_, corners_ = 0;
  CameraBundle& bundle_;
};

}  // namespace

CameraBundle startBundle(const std::vector<BoardView>& views, int width, int height,
                         const std::string& where) {
  std::vector<Mat3> homographies;
  for (const BoardView& view : views) homographies.push_back(homographyOf(view, where));
  CameraBundle bundle;
  bundle.model.width = width;
  bundle.model.height = height;
  bundle.model.cx = (width - 1) / 2.0;
  bundle.model.cy = (height - 1) / 2.0;
  findFocalLengths(homographies, &bundle.model);
  for (const Mat3& H : homographies) bundle.X_CW.push_back(poseOf(H, bundle.model));
  return bundle;
}

Fit adjustBundle(const std::vector<BoardView>& views, int lens_numbers, bool keep_all,
                 CameraBundle* bundle, const std::string& where) {
  return BundleFit(views, lens_numbers, bundle).run(keep_all, where);
}

}  // namespace palpa::calibration
