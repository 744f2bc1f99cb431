// SPDX-License-Identifier: Apache-2.0
/// @file sweep: many closed loops that a file describes, in threads or in the processes of mpirun.
#include "files/folder_lock.hpp"
#include "files/within.hpp"
#include "program.hpp"
#include "sweep_plan.hpp"
#include "table.hpp"

#include <articula/loop/realtime/stop_on_signal.hpp>
#include <articula/sweep/jobs/resumable_sweep.hpp>
#include <articula/text/similar_word.hpp>
#ifdef ARTICULA_PROGRAM_HAS_HDF5
#include <articula/sweep/jobs/sweep_hdf5.hpp>
#endif
#ifdef ARTICULA_PROGRAM_HAS_MPI
#include <articula/sweep/jobs/mpi_session.hpp>
#include <articula/sweep/jobs/resumable_mpi_sweep.hpp>
#endif

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace terminal {

namespace {

using articula::SweepResult;
namespace fs = std::filesystem;

struct SweepCall {
  std::string file{}, output{};
  int threads = 0, chunk = 64;
  bool starts_again = false, compiles = false;
};

/// Refuses metrics and columns that there are not, with their place in the file.
void check_names(const SweepPlan& plan, const AnyExperiment& experiment) {
  std::vector<std::string> metrics, columns;
  for (const auto& metric : experiment.metrics()) metrics.push_back(metric.name);
  columns = metrics;
  for (const auto& parameter : experiment.parameters()) columns.push_back(parameter.name);
  for (const auto& own : plan.search.over) columns.push_back(own.parameter().name);
  const auto check = [&](const std::string& name, const std::vector<std::string>& all,
                         const char* what) {
    if (name.empty() || std::ranges::find(all, name) != all.end()) return;
    throw articula::FileError(plan.names.at(name),
                              "there is no " + std::string(what) + " '" + name + "'",
                              articula::detail::one_of_words(name, all));
  };
  for (const auto& each : plan.options.specifications) check(each.metric, metrics, "metric");
  check(plan.options.worst_metric, metrics, "metric");
  check(plan.search.metric, metrics, "metric");
  for (const SweepPlot& plot : plan.plots) {
    for (const std::string& column : plot.columns) check(column, columns, "column");
  }
}

/// A line on standard error, a few times a second, after the first second.
class SweepProgress {
 public:
  SweepProgress(std::uint64_t all, std::uint64_t first) : all_(all), first_(first) {}
  SweepProgress(const SweepProgress&) = delete;
  SweepProgress& operator=(const SweepProgress&) = delete;
  ~SweepProgress() {
    if (is_shown_) std::fprintf(stderr, "\n");
  }
  void show(std::uint64_t done) {
    const auto now = Clock::now();
    if (now < next_) return;
    next_ = now + std::chrono::milliseconds(500);
    is_shown_ = true;
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const double rate = static_cast<double>(done - first_) / seconds;
    std::fprintf(stderr, "\r%llu of %llu runs, %.0f a second, %.0f s left    ",
                 static_cast<unsigned long long>(done), static_cast<unsigned long long>(all_), rate,
                 static_cast<double>(all_ - done) / std::fmax(rate, 1e-9));
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::uint64_t all_, first_;
  Clock::time_point start_ = Clock::now(), next_ = start_ + std::chrono::seconds(1);
  bool is_shown_ = false;
};

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
std::string cell(double x) { return std::isfinite(x) ? shown(x) : "-"; }
/// A quantile of the sketch, whose error is below 0.5 %.
std::string quantile_cell(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", x);
  return std::isfinite(x) ? text : "-";
}

/// The result as a table and as JSON; both end with the worst runs.
void report(const Program& program, const SweepPlan& plan, const AnyExperiment& experiment,
            const SweepResult& result, const std::string& drawn, const SearchedPlan& searched) {
  Json metrics = Json::array();
  Row head{"metric", "unit", "mean"};
  for (const double share : plan.quantiles) head.push_back(shown(100 * share) + " %");
  head.insert(head.end(), {"highest", "undefined"});
  std::vector<Row> rows{head};
  for (std::size_t k = 0; k < result.metrics().size(); ++k) {
    const articula::MetricSummary& summary = result.summaries()[k];
    const auto& [name, unit] = result.metrics()[k];
    Row row{name, unit, cell(summary.mean())};
    Json quantiles = Json::object();
    for (const double share : plan.quantiles) {
      row.push_back(quantile_cell(summary.quantile(share)));
      quantiles[articula::detail::number_text(share)] = number(summary.quantile(share));
    }
    row.push_back(cell(summary.highest));
    row.push_back(std::to_string(summary.undefined));
    rows.push_back(row);
    metrics.push_back({{"name", name},
                       {"unit", unit},
                       {"mean", number(summary.mean())},
                       {"quantiles", quantiles},
                       {"lowest", number(summary.lowest)},
                       {"highest", number(summary.highest)},
                       {"undefined", summary.undefined}});
  }
  Json worst = Json::array();
  Row worst_head{"worst runs"};
  const std::string by =
      plan.options.worst_metric.empty() ? result.metrics()[0].name : plan.options.worst_metric;
  worst_head.push_back(by);
  for (const auto& parameter : experiment.parameters()) worst_head.push_back(parameter.name);
  std::vector<Row> worst_rows{worst_head};
  const std::size_t metric = articula::detail::metric_index(result.metrics(), by);
  for (const articula::SweepRow& each : result.worst()) {
    Row row{std::to_string(each.number), cell(each.metrics[metric])};
    Json parameters = Json::object();
    for (std::size_t p = 0; p < each.parameters.size(); ++p) {
      row.push_back(shown(each.parameters[p]));
      parameters[experiment.parameters()[p].name] = each.parameters[p];
    }
    worst_rows.push_back(row);
    worst.push_back({{"run", each.number},
                     {"seed", each.seed},
                     {"end", articula::to_string(each.end)},
                     {by, number(each.metrics[metric])},
                     {"parameters", parameters}});
  }
  Json all{{"runs", result.runs()}};
  std::string ends;
  for (std::size_t k = 0; k < result.ends().size(); ++k) {
    const std::string name(articula::simulation_end_names[k]);
    const std::uint64_t count = result.ends()[k];
    all[name] = count;
    ends += (ends.empty() ? "" : ", ") + std::to_string(count) + " " + name;
  }
  std::string text = std::to_string(result.runs()) + " runs: " + ends;
  if (!plan.options.specifications.empty()) {
    text += "; " + std::to_string(result.runs_within()) + " within all specifications";
  }
  const PlannedController& controller = plan.controllers.controllers.front();
  text += "\ncontroller: " + controller.name + " (" +
          std::string(traits_of(controller.kind).class_name) + ")\n" + table(rows) + "\n" +
          table(worst_rows) + "\nrows and plots: " + plan.output;
  if (!drawn.empty()) text += "\n" + drawn;
  all.update({{"controller", controller.name},
              {"within", result.runs_within()},
              {"metrics", metrics},
              {"worst", worst},
              {"output", plan.output}});
  if (!searched.line.empty()) {
    all["search"] = searched.json;
    text = searched.line + "\n" + text;
  }
  program.print(all, text);
}

/// The experiment of a plan.
/// @throws Refusal naming the file, if the plan's loops cannot be simulated
AnyExperiment checked_experiment(const SweepPlan& plan, const std::string& file) {
  try {
    return experiment_of(plan);
  } catch (const std::invalid_argument& error) {
    throw Refusal(file + ": " + error.what());
  }
}

/// All that a sweep needs before its search and its first run.
struct PreparedSweep {
  SweepPlan plan{};
  AnyExperiment experiment{};
};

PreparedSweep prepare(const SweepCall& call, bool is_distributed) {
  if (is_distributed && call.threads > 1) {
    throw Refusal("--threads is not for mpirun: each rank computes in one thread");
  }
  SweepPlan plan = read_sweep(call.file, call.compiles);
  if (call.compiles) plan.compiled = compiled_experiment(plan);
  if (!call.output.empty()) plan.output = call.output;
  plan.options.threads = call.threads;
  plan.options.chunk = static_cast<std::uint64_t>(call.chunk);
  if (!plan.search.metric.empty() && is_distributed) {
    throw Refusal("a search runs in one process: start it without mpirun");
  }
  AnyExperiment experiment = checked_experiment(plan, call.file);
  check_names(plan, experiment);
  static_cast<void>(articula::sweep_columns(experiment.parameters(), experiment.metrics()));
  return {std::move(plan), std::move(experiment)};
}

/// The sweep in this process, which has the files, and those of mpirun.
void run_sweep(const Program& program, const SweepCall& call, const PreparedSweep& prepared,
               const auto& sweeps) {
  SearchedPlan searched{.plan = prepared.plan};
  const SweepPlan& plan = searched.plan;
  AnyExperiment experiment = prepared.experiment;
  const auto print = [](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) std::fprintf(stderr, "note: %s\n", note.c_str());
  };
  print(plan.notes);
  print(plan.controllers.notes);
  print((*plan.robot)->notices);
  print(experiment.notes);
  fs::create_directories(plan.output);
  const fs::path folder = plan.output;
  const FolderLock lock(folder, FolderLock::IfTaken::refuse);
  if (!plan.search.metric.empty()) {
    searched = search_sweep(prepared.plan);
    experiment = checked_experiment(plan, call.file);
  }
  if (call.starts_again) fs::remove(folder / "checkpoint");
  const articula::Samples samples(experiment.parameters(), plan.options.sampling);
  articula::StopFlag stop;
  const articula::StopOnSignal on_signal(stop);
  std::unique_ptr<SweepProgress> progress;
  articula::SweepHooks hooks;
  hooks.progress = [&](const SweepResult& so_far) {
    if (!progress) progress = std::make_unique<SweepProgress>(samples.runs(), so_far.runs());
    progress->show(so_far.runs());
    return !stop.requested();
  };
  const articula::SweepFiles files{folder / "rows.csv", folder / "checkpoint", 1, plan.text};
  const SweepResult result = sweeps(experiment, plan.options, files, hooks);
  progress.reset();
  if (result.runs() < samples.runs()) {
    throw Refusal("stopped after " + std::to_string(result.runs()) + " of " +
                  std::to_string(samples.runs()) + " runs; the same command goes on");
  }
  report(program, plan, experiment, result, draw_sweep(plan, experiment), searched);
#ifdef ARTICULA_PROGRAM_HAS_HDF5
  articula::write_hdf5(folder / "rows.h5", folder / "rows.csv", experiment.parameters(),
                       experiment.metrics());
#endif
}

#ifdef ARTICULA_PROGRAM_HAS_MPI
/// The sweep in the processes of mpirun.
void sweep_with_mpi(const Program& program, const SweepCall& call,
                    const articula::MpiSession& mpi) {
  const auto sweeps = [](const auto&... all) { return articula::resumable_sweep_with_mpi(all...); };
  std::optional<PreparedSweep> prepared;
  std::string reason;
  try {
    prepared = prepare(call, true);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  // One rank tells the reason, which is usually the same in all, and ends the others.
  const auto fail = [&](const char* text) {
    std::fprintf(stderr, "articula: %s\n", text);
    mpi.abort(refused);
  };
  if (const int first = mpi.first_rank_with(!prepared); first < mpi.ranks()) {
    if (first == mpi.rank()) fail(reason.c_str());
    static_cast<void>(mpi.first_rank_with(false));  // waits for the end
  }
  try {
    if (mpi.rank() == 0) return run_sweep(program, call, *prepared, sweeps);
    static_cast<void>(sweeps(prepared->experiment, prepared->plan.options,
                             articula::SweepFiles{.identity = prepared->plan.text},
                             articula::SweepHooks{}));
  } catch (const std::exception& error) {  // the other ranks would wait forever
    // Usually rank 0 fails, too, and has the better reason.
    if (mpi.rank() > 0) std::this_thread::sleep_for(std::chrono::seconds(2));
    fail(error.what());
  }
}
#endif

void sweep(const Program& program, const SweepCall& call) {
#ifdef ARTICULA_PROGRAM_HAS_MPI
  const articula::MpiSession mpi;
  if (mpi.is_active()) return sweep_with_mpi(program, call, mpi);
#endif
  run_sweep(program, call, prepare(call, false),
            [](const auto&... all) { return articula::resumable_sweep(all...); });
}

}  // namespace

void add_sweep_command(CLI::App& app, Program& program) {
  const auto call = std::make_shared<SweepCall>();
  CLI::App* command = add_command(
      app, program, "sweep", "Runs a closed loop many times with other parameters, or goes on.",
      [&program, call] { sweep(program, *call); });
  command->add_option("file", call->file, "YAML of the sweep, see docs/sweeps.md")->required();
  command->add_option("--output", call->output, "folder of rows, checkpoint and plots")
      ->default_str("that of the file");
  command->add_option("--threads", call->threads, "0: one for each processor")
      ->check(within(0, 1024))
      ->capture_default_str();
  command->add_option("--chunk", call->chunk, "runs that a thread or process takes at once")
      ->check(within(1, 10'000))
      ->capture_default_str();
  command->add_flag("--compile", call->compiles,
                    "compile the robot for the lanes of this processor, and keep it");
  command->add_flag("--fresh", call->starts_again, "start again in place of going on");
}

}  // namespace terminal
