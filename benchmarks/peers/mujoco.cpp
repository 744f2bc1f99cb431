// SPDX-License-Identifier: Apache-2.0
#include "peers/mujoco.hpp"
#include "peer.hpp"

#include <algorithm>

namespace peers {
namespace {

class MujocoPeer final : public Peer {
 public:
  MujocoPeer(support::Mujoco mujoco, const articula::LinkFrame& link,
             const std::vector<State>& states, Pipeline pipeline)
      : mujoco_(std::move(mujoco)),
        link_(link),
        body_(link.body + 1),  // 0 is the world
        states_(states),
        pipeline_(pipeline),
        joints_(static_cast<std::size_t>(mujoco_.model->nv)),
        numbers_(joints_),
        matrix_(joints_ * joints_),
        jacobian_(6 * joints_) {}

  /// What has no whole function has a shortest pipeline only.
  [[nodiscard]] bool offers(Operation operation) const override {
    const bool parts = operation == Operation::gravity || operation == Operation::mass_matrix ||
                       operation == Operation::forward_kinematics ||
                       operation == Operation::jacobian;
    return parts ? pipeline_ == Pipeline::shortest
                 : operation != Operation::step || pipeline_ == Pipeline::whole;
  }

  void run(Operation operation, std::size_t index) override {
    const State& s = states_[index];
    const mjModel* model = mujoco_.model.get();
    mjData* data = mujoco_.data.get();
    copy(s.q, data->qpos);
    switch (operation) {
      case Operation::inverse_dynamics:
        copy(s.v, data->qvel);
        copy(s.a, data->qacc);
        if (pipeline_ == Pipeline::whole) return mj_inverse(model, data);
        place(model, data);
        mj_comVel(model, data);
        return mj_rne(model, data, 1, numbers_.data());
      case Operation::gravity:
        std::fill_n(data->qvel, joints_, 0);
        place(model, data);
        mj_comVel(model, data);
        return mj_rne(model, data, 0, numbers_.data());
      case Operation::mass_matrix:
        place(model, data);
        mj_crb(model, data);
        return mj_fullM(model, matrix_.data(), data->qM);
      case Operation::forward_dynamics:
        copy(s.v, data->qvel);
        copy(s.effort, data->qfrc_applied);
        if (pipeline_ == Pipeline::whole) return mj_forward(model, data);
        place(model, data);
        mj_crb(model, data);
        mj_factorM(model, data);
        mj_comVel(model, data);
        mj_rne(model, data, 0, numbers_.data());
        for (std::size_t i = 0; i < joints_; ++i) numbers_[i] = s.effort[i] - numbers_[i];
        return mj_solveM(model, data, data->qacc, numbers_.data(), 1);
      case Operation::step:
        copy(s.v, data->qvel);
        copy(s.effort, data->qfrc_applied);
        return mj_step(model, data);
      case Operation::forward_kinematics:
        mj_kinematics(model, data);
        return place_link();
      case Operation::jacobian:
        place(model, data);
        place_link();
        return mj_jac(model, data, jacobian_.data(), jacobian_.data() + 3 * joints_,
                      link_place_.data() + 9, body_);
    }
  }
  [[nodiscard]] Numbers result(Operation operation) const override {
    const mjData* data = mujoco_.data.get();
    const auto numbers = [&](const mjtNum* first) { return Numbers(first, first + joints_); };
    switch (operation) {
      case Operation::inverse_dynamics:
        return pipeline_ == Pipeline::whole ? numbers(data->qfrc_inverse) : numbers_;
      case Operation::gravity:
        return numbers_;
      case Operation::mass_matrix:
        return matrix_;
      case Operation::forward_dynamics:
        return numbers(data->qacc);
      case Operation::forward_kinematics: {
        Numbers result(12);  // MuJoCo's matrices are by rows
        for (std::size_t k = 0; k < 9; ++k) result[k] = link_place_[3 * (k % 3) + k / 3];
        std::copy_n(link_place_.begin() + 9, 3, result.begin() + 9);
        return result;
      }
      case Operation::jacobian: {
        Numbers result(6 * joints_);
        for (std::size_t k = 0; k < result.size(); ++k) {
          result[k] = jacobian_[(k % 6) * joints_ + k / 6];
        }
        return result;
      }
      case Operation::step:
        break;
    }
    Numbers result = numbers(data->qpos);
    result.insert(result.end(), data->qvel, data->qvel + joints_);
    return result;
  }

 private:
  static void copy(const Numbers& from, mjtNum* to) { std::copy(from.begin(), from.end(), to); }
  static void place(const mjModel* model, mjData* data) {
    mj_kinematics(model, data);
    mj_comPos(model, data);
  }

  /// Where the link is on its body: rotation by rows, translation.
  void place_link() {
    const mjData* data = mujoco_.data.get();
    const mjtNum* body_rotation = data->xmat + 9 * body_;
    mjtNum rotation[9];  // NOLINT
    for (std::size_t k = 0; k < 9; ++k) {
      const articula::Vector3<double>& row = link_.placement.rotation.rows[k / 3];
      rotation[k] = k % 3 == 0 ? row.x : k % 3 == 1 ? row.y : row.z;
    }
    const articula::Vector3<double>& t = link_.placement.translation;
    const mjtNum translation[] = {t.x, t.y, t.z};  // NOLINT
    mju_mulMatMat(link_place_.data(), body_rotation, rotation, 3, 3, 3);
    mju_rotVecMat(link_place_.data() + 9, translation, body_rotation);
    mju_addTo3(link_place_.data() + 9, data->xpos + 3 * body_);
  }

  support::Mujoco mujoco_;
  articula::LinkFrame link_;
  int body_;  ///< that carries the link
  std::vector<State> states_;
  Pipeline pipeline_;
  std::size_t joints_;
  Numbers numbers_;  ///< efforts of the last run
  Numbers matrix_;
  Numbers jacobian_;  ///< by rows
  std::array<mjtNum, 12> link_place_{};
};

}  // namespace

std::unique_ptr<Peer> mujoco(std::span<const articula::Body> bodies,
                             const articula::Vector3<double>& gravity,
                             const articula::LinkFrame& link, const std::vector<State>& states,
                             Pipeline pipeline) {
  return std::make_unique<MujocoPeer>(support::load_mujoco(bodies, gravity, step_time), link,
                                      states, pipeline);
}

}  // namespace peers
