// SPDX-License-Identifier: Apache-2.0
#include <articula/sim/joint_sensors.hpp>

#include <array>
#include <cmath>
#include <cstddef>

#include "catch.hpp"

using namespace articula;

namespace {

JointState<2> state_of(double position, double velocity) {
  JointState<2> state;
  state.position.setConstant(position);
  state.velocity.setConstant(velocity);
  state.effort.setConstant(7);
  return state;
}

/// All that is measured of a state, in one column.
Eigen::Matrix<double, 6, 1> column(const JointState<2>& state) {
  Eigen::Matrix<double, 6, 1> all;
  all << state.position, state.velocity, state.effort;
  return all;
}

}  // namespace

TEST_CASE("without options the measurement is exact") {
  JointSensors<2> sensors(SimulatorOptions<2>{});
  const JointState<2> truth = state_of(0.123456789, -3.21);
  CHECK(column(sensors.measure(truth)) == column(truth));
}

TEST_CASE("an encoder gives whole steps, the nearest one, and velocity as their difference") {
  SimulatorOptions<2> options{.period = 0.5};
  options.encoder_resolution = {0.25, 0};
  JointSensors<2> sensors(options);

  JointState<2> measured = sensors.measure(state_of(0.3, 1));
  CHECK(measured.position == Eigen::Vector2d(0.25, 0.3));
  CHECK(measured.velocity == Eigen::Vector2d(1, 1));  // no measurement before this one

  measured = sensors.measure(state_of(0.4, 1));
  CHECK(measured.position == Eigen::Vector2d(0.5, 0.4));
  CHECK(measured.velocity == Eigen::Vector2d((0.5 - 0.25) / 0.5, 1));

  measured = sensors.measure(state_of(-0.4, 1));
  CHECK(measured.position == Eigen::Vector2d(-0.5, -0.4));
  CHECK(measured.velocity == Eigen::Vector2d(-2, 1));
  CHECK(measured.effort == Eigen::Vector2d(7, 7));

  measured = sensors.measure(state_of(-0.6, 100));
  CHECK(measured.velocity == Eigen::Vector2d(0, 100));  // the same step
}

TEST_CASE("any position lies within half a step of its measurement, which is a multiple") {
  const double resolution = 2e-3 / 3;
  SimulatorOptions<2> options;
  options.encoder_resolution.setConstant(resolution);
  JointSensors<2> sensors(options);
  for (int k = -1000; k <= 1000; ++k) {
    const double position = 1.7e-5 * k * (1 + 0.001 * k);
    const double measured = sensors.measure(state_of(position, 0)).position[0];
    CHECK(std::abs(measured - position) <= resolution / 2 * (1 + 1e-12));
    CHECK(measured == resolution * std::round(measured / resolution));
  }
}

TEST_CASE("noise comes before the encoder") {
  SimulatorOptions<2> options;
  options.encoder_resolution.setConstant(0.25);
  options.position_noise.setConstant(1);
  JointSensors<2> sensors(options);
  bool moved = false;
  for (int k = 0; k < 100; ++k) {
    const double measured = sensors.measure(state_of(0, 0)).position[0];
    CHECK(measured == 0.25 * std::round(4 * measured));
    moved = moved || measured != 0;
  }
  CHECK(moved);
}

TEST_CASE("noise has mean 0, the deviation that was asked for, and no memory") {
  SimulatorOptions<2> options{.seed = 11};
  CAPTURE(options.seed);
  options.position_noise = {1e-3, 0};
  options.velocity_noise = {0.02, 5};
  options.effort_noise = {0, 0.3};
  Eigen::Matrix<double, 6, 1> deviation;
  deviation << options.position_noise, options.velocity_noise, options.effort_noise;
  JointSensors<2> sensors(options);
  const JointState<2> truth = state_of(0.5, -2);

  constexpr int samples = 100000;
  Eigen::Matrix<double, 6, 1> sum, square, product, last;
  sum.setZero();
  square.setZero();
  product.setZero();
  last.setZero();
  double joints_together = 0;
  for (int k = 0; k < samples; ++k) {
    const Eigen::Matrix<double, 6, 1> error = column(sensors.measure(truth)) - column(truth);
    sum += error;
    square += error.cwiseAbs2();
    product += error.cwiseProduct(last);
    joints_together += error[2] * error[3];
    last = error;
  }
  // Of n samples the mean strays by sigma / sqrt(n), the mean square by sigma^2 sqrt(2 / n), the
  // mean product by sigma^2 / sqrt(n). Five times that is exceeded once in two million cases.
  const double stray = 5 / std::sqrt(static_cast<double>(samples));
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    const double s = deviation[i];
    CHECK(std::abs(sum[i]) / samples <= stray * s);
    CHECK(std::abs(square[i] / samples - s * s) <= stray * std::sqrt(2.0) * s * s);
    CHECK(std::abs(product[i]) / samples <= stray * s * s);
  }
  CHECK(std::abs(joints_together) / samples <= stray * deviation[2] * deviation[3]);
}

TEST_CASE("another seed gives other noise, the same seed the same") {
  SimulatorOptions<2> options{.seed = 1};
  options.position_noise.setConstant(1e-3);
  JointSensors<2> one(options), again(options);
  options.seed = 2;
  JointSensors<2> other(options);
  const JointState<2> truth = state_of(0, 0);
  const auto first = column(one.measure(truth));
  CHECK(first == column(again.measure(truth)));
  CHECK(first != column(other.measure(truth)));
}
