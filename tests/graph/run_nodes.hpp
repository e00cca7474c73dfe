#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <stdexcept>

#include "graph/api/node.hpp"
#include "tests/support/pipeline_builder.hpp"

// Small node types for the tests of the runner.
namespace atrium::test {

/// A number that knows how many of its kind are alive.
struct Counted {
  static constexpr std::string_view port_type = "Counted";
  static constexpr auto members() { return std::tuple{&Counted::value}; }
  explicit Counted(std::int64_t v = 0) : value(v) { grow(); }
  Counted(const Counted& other) : value(other.value) { grow(); }
  Counted(Counted&& other) noexcept : value(other.value) { grow(); }
  Counted& operator=(const Counted&) = default;
  Counted& operator=(Counted&&) = default;
  ~Counted() { --alive; }

  std::int64_t value;
  inline static std::atomic<int> alive = 0, most = 0;

 private:
  static void grow() {
    const int now = ++alive;
    for (int seen = most; now > seen && !most.compare_exchange_weak(seen, now);) {
    }
  }
};

/// sum of the inputs · 3 + add, modulo 2^64; mode makes it misbehave.
struct Sum {
  static constexpr std::string_view type = "test.sum";
  static constexpr std::string_view summary = "Adds.";
  struct In {
    Inputs<Counted> terms;
  };
  struct Out {
    Counted sum;
  };
  struct Params {
    std::int64_t add = 1;
    bool fail = false;
  };
  static constexpr auto inputs = std::tuple{port<&In::terms>("Numbers.")};
  static constexpr auto outputs = std::tuple{port<&Out::sum>("Their sum.")};
  static constexpr auto params =
      std::tuple{param<&Params::add>(count, unbounded, "Added."), param<&Params::fail>("Throws.")};
  static std::int64_t value_of(const std::vector<std::int64_t>& terms, std::int64_t add) {
    auto sum = static_cast<std::uint64_t>(add);
    for (const auto t : terms) sum += 3 * static_cast<std::uint64_t>(t);
    return static_cast<std::int64_t>(sum);
  }
  static Out run(const In& in, const Params& params, Context& /*context*/) {
    if (params.fail) throw Error("told to fail", "do not tell it");
    std::vector<std::int64_t> terms;
    for (const auto& t : in.terms) terms.push_back(t->value);
    return {Counted(value_of(terms, params.add))};
  }
};

/// A value of which nothing can be told.
struct Secret {
  static constexpr std::string_view port_type = "Secret";
  static constexpr auto members() { return std::tuple{&Secret::value}; }
  static std::vector<Fact> facts(const Secret& /*secret*/) { throw std::runtime_error("it is secret"); }
  double value = 0;
};
struct Hide {
  static constexpr std::string_view type = "test.hide";
  static constexpr std::string_view summary = "Gives a value of which nothing can be told.";
  struct In {};
  struct Out {
    Secret secret;
  };
  struct Params {};
  static constexpr auto inputs = std::tuple{};
  static constexpr auto outputs = std::tuple{port<&Out::secret>("A value.")};
  static constexpr auto params = std::tuple{};
  static Out run(const In& /*in*/, const Params& /*params*/, Context& /*context*/) { return {}; }
};

/// Calls a function of the test.
struct Call {
  static constexpr std::string_view type = "test.call";
  static constexpr std::string_view summary = "Calls a function of the test.";
  struct In {
    OptionalInput<Counted> after;
  };
  struct Out {
    SharedOutput<Counted> value;
  };
  struct Params {
    std::int64_t which = 0;
  };
  static constexpr auto inputs = std::tuple{port<&In::after>("Runs after this.")};
  static constexpr auto outputs = std::tuple{port<&Out::value>("What the function returns.")};
  static constexpr auto params = std::tuple{param<&Params::which>(count, unbounded, "Which function.")};
  using Function = std::function<std::shared_ptr<const Counted>(Context&)>;
  inline static std::vector<Function> functions;
  static Out run(const In& /*in*/, const Params& params, Context& context) {
    return {functions.at(static_cast<std::size_t>(params.which))(context)};
  }
};

/// Adds a node that calls the function, after what `after` comes from; returns its number.
inline std::size_t add_call(PipelineBuilder& builder, const std::string& name, Call::Function function,
                            std::vector<Source> after = {}) {
  Call::functions.push_back(std::move(function));
  const auto n = builder.add<Call>(name, {std::move(after)});
  builder.set("which", static_cast<std::int64_t>(Call::functions.size() - 1));
  return n;
}

}  // namespace atrium::test
