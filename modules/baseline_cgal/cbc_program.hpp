#pragma once
// CBC as a solver of CGAL's mixed integer programs: a model of CGAL's concept MixedIntegerProgramTraits.
#include <CGAL/Mixed_integer_program_traits.h>
#include <Cbc_C_Interface.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace atrium::baseline {

/// CGAL makes its solver itself, so what a solver is to know and to tell goes through one place in the program.
struct CbcSettings {
  std::chrono::steady_clock::time_point deadline;
  bool accept_unproven = false;  ///< at the deadline, take the best solution so far
};
struct CbcReport {
  int variables = 0, constraints = 0;
  bool proven = false;  ///< the solution is the best one
  bool out_of_time = false;
  double objective = 0, bound = 0;
};
inline CbcSettings cbc_settings;
inline CbcReport cbc_report;

class CbcProgram : public CGAL::Mixed_integer_program_traits<double> {
 public:
  bool solve() override {
    const auto columns = static_cast<int>(variables_.size());
    const auto rows = static_cast<int>(constraints_.size());
    cbc_report = {columns, rows};
    const std::unique_ptr<Cbc_Model, void (*)(Cbc_Model*)> model(Cbc_newModel(), Cbc_deleteModel);
    load(model.get(), columns, rows);
    const double left = std::chrono::duration<double>(cbc_settings.deadline - std::chrono::steady_clock::now()).count();
    set(model.get(), "timeMode", "elapsed");
    set(model.get(), "seconds", std::to_string(std::max(left, 0.01)));
    set(model.get(), "threads", "0");
    set(model.get(), "randomCbcSeed", "1");
    Cbc_solve(model.get());
    return take_solution(model.get(), columns);
  }

 private:
  static void set(Cbc_Model* model, const char* name, const std::string& value) {
    Cbc_setParameter(model, name, value.c_str());
  }

  void load(Cbc_Model* model, int columns, int rows) const {
    std::vector<std::vector<std::pair<int, double>>> entries(columns);  // by column: row and coefficient
    std::vector<double> row_low(rows), row_high(rows), low(columns), high(columns), cost(columns, 0.0);
    for (int r = 0; r < rows; ++r) {
      constraints_[r]->get_bounds(row_low[r], row_high[r]);
      for (const auto& [variable, coefficient] : constraints_[r]->coefficients())
        entries[variable->index()].emplace_back(r, coefficient);
    }
    for (const auto& [variable, coefficient] : objective_->coefficients()) cost[variable->index()] = coefficient;
    std::vector<CoinBigIndex> start{0};
    std::vector<int> index;
    std::vector<double> value;
    for (int c = 0; c < columns; ++c) {
      variables_[c]->get_bounds(low[c], high[c]);
      for (const auto& [row, coefficient] : entries[c]) {
        index.push_back(row);
        value.push_back(coefficient);
      }
      start.push_back(static_cast<CoinBigIndex>(index.size()));
    }
    Cbc_loadProblem(model, columns, rows, start.data(), index.data(), value.data(), low.data(), high.data(),
                    cost.data(), row_low.data(), row_high.data());
    for (int c = 0; c < columns; ++c)
      if (variables_[c]->variable_type() != Variable::CONTINUOUS) Cbc_setInteger(model, c);
    Cbc_setObjSense(model, objective_->sense() == Linear_objective::MAXIMIZE ? -1 : 1);
  }

  bool take_solution(Cbc_Model* model, int columns) {
    cbc_report.proven = Cbc_isProvenOptimal(model) != 0;
    cbc_report.out_of_time = !cbc_report.proven && Cbc_status(model) == 1;
    cbc_report.bound = Cbc_getBestPossibleObjValue(model);
    const double* solution = Cbc_bestSolution(model);
    if (solution == nullptr || (!cbc_report.proven && !(cbc_report.out_of_time && cbc_settings.accept_unproven)))
      return false;
    cbc_report.objective = Cbc_getObjValue(model);
    result_.resize(columns);
    for (int c = 0; c < columns; ++c) {
      result_[c] = variables_[c]->variable_type() == Variable::CONTINUOUS ? solution[c] : std::round(solution[c]);
      variables_[c]->set_solution_value(result_[c]);
    }
    return true;
  }
};

}  // namespace atrium::baseline
