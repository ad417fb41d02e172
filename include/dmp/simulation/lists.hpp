#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <vector>
#include <dmp/core/require.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/neighbours/pair_list.hpp>
#include <dmp/neighbours/relative_motion.hpp>
#include <dmp/neighbours/spatial_order.hpp>
#include <dmp/simulation/model.hpp>

namespace dmp::simulation {

/// Who is near whom in a model: ghosts, the lists of its pairs, and when they are worn.
template <int Dim, bool KeepsRates, class Precision, class... Item>
class Lists : public Model<Dim, KeepsRates, Precision, Item...> {
  using Base = Model<Dim, KeepsRates, Precision, Item...>;

 public:
  using Base::for_each_group, Base::for_each_item, Base::has_pairs;

  Lists(const geometry::Box<Dim>& box, const Item&... item) : Base(box, item...) {
    for_each_item([&](const auto& active) {
      if constexpr (is_interaction<std::remove_cvref_t<decltype(active.item)>>) {
        longest_cutoff_ = std::max(longest_cutoff_, active.item.cutoff());
        shortest_cutoff_ = std::min(shortest_cutoff_, active.item.cutoff());
      }
    });
    skin_ = 0.15 * longest_cutoff_;  // least time of a step, see docs/performance.md
  }

  [[nodiscard]] double skin() const noexcept { return skin_; }
  [[nodiscard]] double longest_cutoff() const noexcept { return longest_cutoff_; }
  [[nodiscard]] std::uint64_t list_builds() const noexcept { return list_builds_; }
  void set_skin(double skin) noexcept { skin_ = skin; }
  /// Beside what groups and items hold: for sorting, and for knowing when lists are worn.
  [[nodiscard]] std::size_t bytes() const noexcept { return order_.bytes() + relative_motion_.bytes(); }

 protected:
  using typename Base::Lanes;
  template <class G>
  using LayoutOf = typename Base::template LayoutOf<G>;
  template <class G>
  static constexpr bool evolves = Base::template evolves<G>;

  /// Wraps positions into the periodic box, sorts the particles in space, finds ghosts and neighbours.
  void find_neighbours() {
    for_each_group([this](auto& g) { wrap(g.positions(), g.blocks.ranges()); });
    if constexpr (has_pairs) {
      lay_out_cells();
      for_each_group([&](auto& g) { sort_in_space(g); });
      this->renew_exclusions();
      for_each_group([&](auto& g) { prepare_sources(g); });
      for_each_item([&](auto& active) {
        using I = std::remove_cvref_t<decltype(active.item)>;
        if constexpr (is_interaction<I>) {
          auto& a = this->template group<typename I::A>();
          auto& b = this->template group<typename I::B>();
          const double cutoff = active.item.cutoff();
          list(a, b, active.of_a, active.excluded_of_a, cutoff);
          if constexpr (!std::is_same_v<typename I::A, typename I::B>) list(b, a, active.of_b, active.excluded_of_b, cutoff);
        }
      });
    }
    for_each_item([&](auto& active) {
      using I = std::remove_cvref_t<decltype(active.item)>;
      if constexpr (is_bonds<I>) {
        auto& a = this->template group<typename I::A>();
        auto& b = this->template group<typename I::B>();
        mark_crossing(active.of_a, a, b);
        mark_crossing(active.of_b, b, a);
      }
    });
    for_each_group([&](auto& g) { divide(g); });
    if constexpr (has_pairs) follow_from_here();
    ++list_builds_;
  }

  /// Whether particles may have come near each other that are not in the lists, or all have gone too far; and how far the lists must be
  /// read until then.
  [[nodiscard]] bool lists_are_worn() {
    if constexpr (has_pairs) {
      if (this->exclusions_are_worn()) return true;
      const auto wear = relative_motion_.find_wear();
      if (!(wear.afar <= skin_)) return true;
      if (wear.farthest > longest_cutoff_) return true;  // time to go back into the periodic box
      if (!(wear.nearby <= skin_) && neighbours_have_met()) return true;
      for_each_group([this](auto& g) {
        if constexpr (has_lists<decltype(g)>)
          for_each_block(g.blocks, [&](std::size_t, std::size_t block) {
            relative_motion_.for_each_run(g.first_run, block, [&](std::size_t, const neighbours::Run run) {
              const std::size_t level = neighbours::PairList::level_at(relative_motion_.used(run.cell) / skin_);
              std::fill(g.level.data() + run.first, g.level.data() + run.end, static_cast<std::uint8_t>(level));
            });
          });
      });
    }
    return false;
  }

  /// Calls function(i) for the rows of a block, and keeps account of how far they have gone since the lists were built.
  template <class G, class Function>
  void follow(const G& g, std::size_t block, const Function& function) {
    if constexpr (G::Mobility::moves && LayoutOf<G>::has_pairs) {
      relative_motion_.for_each_run(g.first_run, block, [&](std::size_t number, const neighbours::Run run) {
        neighbours::Bounds<Dim> bounds;
        for (std::size_t i = run.first; i < run.end; ++i) {
          function(i);
          bounds.add(g.positions()[i] - g.at_list_build[i]);
        }
        relative_motion_.set_displacement(number, bounds);
      });
    } else {
      for (std::size_t i = g.blocks.begin(block); i < g.blocks.end(block); ++i) function(i);
    }
  }

 private:
  /// Whether the particles of a group list their neighbours; those of others are listed at most.
  template <class G>
  static constexpr bool has_lists = LayoutOf<G>::has_pairs && evolves<G>;

  void wrap(std::span<Vector<Dim>> positions, const Ranges& ranges) const {
    for_each_range(ranges, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) positions[i] = this->box_.wrap(positions[i]);
    });
  }
  /// Coarse cells over all that can be found by pair laws, and how records write positions there.
  void lay_out_cells() {
    neighbours::Bounds<Dim> bounds;
    std::size_t particles = 0;
    for_each_group([&](auto& g) {
      if constexpr (LayoutOf<decltype(g)>::has_pairs) {
        particles += g.size();
        bounds.add(neighbours::bounds_of<Dim>(g.size(), neighbours::Positions<Dim>{g.positions()}));
      }
    });
    const double reach = longest_cutoff_ + skin_;
    relative_motion_.build(bounds, this->box_, longest_cutoff_, skin_, particles);
    const double extent = 2.0 * ((bounds.upper - bounds.lower).maxCoeff() + 4.0 * reach);  // room for ghosts, and for moving along
    for_each_group([&](auto& g) { g.records.set_frame({0.5 * (bounds.lower + bounds.upper), extent}); });
  }

  /// Neighbours in space become neighbours in memory, and those of a coarse cell one run.
  template <class G>
  void sort_in_space(G& g) {
    if constexpr (LayoutOf<G>::has_pairs && G::Mobility::moves) {
      if (g.may_be_sorted) {
        const auto& cells = relative_motion_.cells();
        order_.build(g.positions(), cells, g.spacing > 0.0 ? cells.width.prod() / std::pow(g.spacing, Dim) : 0.0, 2);
        g.blocks.set_bounds(order_.bounds());

        // Records are packed anew after this: their memory is free, and takes one column at a time.
        const std::size_t rows_for_a_column = g.size() * Dim * sizeof(double) / G::Records::bytes_per_particle() + 1;
        g.records.resize(std::max(g.records.size(), rows_for_a_column));
        g.columns.permute(order_.rows(), g.blocks.ranges(), reinterpret_cast<double*>(g.records.data()));
        auto* const id = reinterpret_cast<std::uint32_t*>(g.records.data());
        std::copy(g.id.begin(), g.id.end(), id);
        for (std::size_t k = 0; k < g.size(); ++k) g.id[k] = id[order_.rows()[k]];
      }
    }
  }

  template <class G>
  void prepare_sources(G& g) {  // ghosts and the grid in which others search
    if constexpr (LayoutOf<G>::has_pairs) {
      const double reach = longest_cutoff_ + skin_;
      for (const double period : this->periods_)
        if (period > 0.0 && period <= reach)
          throw ParameterError("scene: a periodic box must be longer than support radius and skin (" + to_text(reach) + " m), got " +
                               to_text(period));
      g.ghosts.build(g.positions(), this->box_, reach);
      g.grid.build({g.positions(), g.ghosts.owner, g.ghosts.shift}, 0.8 * reach);
    }
  }

  template <class A, class B>
  void list(const A& of, const B& sources, neighbours::PairList& pairs, const neighbours::Exclusions& excluded, double cutoff) {
    if constexpr (evolves<A>)
      pairs.template build<Dim>(of.blocks, of.positions(), sources.grid, cutoff, skin_, sources.sources(std::is_same_v<A, B>), excluded,
                                Lanes::width);
  }

  template <class A, class B>
  void mark_crossing(neighbours::BondList& bonds, const A& own, const B& partners) {
    if (bonds.empty() || std::find(this->box_.periodic.begin(), this->box_.periodic.end(), true) == this->box_.periodic.end()) return;
    bonds.template mark_crossing<Dim>(own.positions(), partners.positions(), this->box_);
  }

  /// Shares the blocks of a group among the threads by what a sweep over them costs: entries of lists, and about ten more per particle.
  template <class G>
  void divide(G& g) {
    if constexpr (evolves<G>)
      g.blocks.divide([&](std::size_t block) {
        double cost = 10.0 * static_cast<double>(g.blocks.end(block) - g.blocks.begin(block));
        for_each_item([&](const auto& active) {
          using I = std::remove_cvref_t<decltype(active.item)>;
          if constexpr (is_interaction<I> || is_bonds<I>) {
            if constexpr (std::is_same_v<typename G::Tag, typename I::A>) cost += active.of_a.entries(g.blocks, block);
            else if constexpr (std::is_same_v<typename G::Tag, typename I::B>) cost += active.of_b.entries(g.blocks, block);
          }
        });
        return cost;
      });
  }

  /// The present positions are what relative motion is counted from.
  void follow_from_here() {
    for_each_group([&](auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_pairs) {
        if constexpr (G::Mobility::moves) g.at_list_build = g.positions();
        relative_motion_.follow(g.blocks, g.positions(), g.first_run);
        if constexpr (has_lists<G>) g.level.assign(g.size(), 0);
      }
    });
    relative_motion_.find_occupied();
  }

  /// Whether particles in cells that touch may act on each other that are not in the lists, as their pairs show.
  [[nodiscard]] bool neighbours_have_met() {
    std::array<typename neighbours::RelativeMotion<Dim>::Followed, sizeof...(Item)> groups;
    std::size_t followed = 0;
    for_each_group([&](const auto& g) {
      using G = std::remove_cvref_t<decltype(g)>;
      if constexpr (LayoutOf<G>::has_pairs)
        groups[followed++] = {g.first_run.front(), G::Mobility::moves ? std::span(g.at_list_build) : std::span(g.positions()),
                              g.positions()};
    });
    return relative_motion_.have_met({groups.data(), followed}, shortest_cutoff_);
  }

  double longest_cutoff_ = 0.0, shortest_cutoff_ = std::numeric_limits<double>::infinity(), skin_ = 0.0;
  neighbours::RelativeMotion<Dim> relative_motion_;  // since the lists were built
  neighbours::SpatialOrder<Dim> order_;
  std::uint64_t list_builds_ = 0;
};

}  // namespace dmp::simulation
