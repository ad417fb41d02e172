#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>
#include <dmp/core/aligned.hpp>
#include <dmp/core/field.hpp>
#include <dmp/core/threads.hpp>
#include <dmp/neighbours/cell_grid.hpp>
#include <dmp/neighbours/ghosts.hpp>
#include <dmp/neighbours/pair_list.hpp>
#include <dmp/neighbours/relative_motion.hpp>
#include <dmp/particles/columns.hpp>
#include <dmp/particles/records.hpp>
#include <dmp/particles/sums.hpp>
#include <dmp/particles/view.hpp>
#include <dmp/simulation/composition.hpp>

namespace dmp::simulation {

namespace detail {
/// What a group needs to be found by pair laws; nothing where there are none.
template <int Dim, bool HasPairs>
struct Neighbourhood {};
template <int Dim>
struct Neighbourhood<Dim, true> {
  neighbours::Ghosts<Dim> ghosts{};
  neighbours::CellGrid<Dim> grid{};
  AlignedVector<Vector<Dim>> at_list_build{};             ///< positions when the neighbour lists were built
  std::vector<std::size_t> first_run{};                   ///< of each block, of those whose displacements RelativeMotion wants
  std::vector<std::uint8_t> level{};                      ///< of each particle: how far its lists must be read (PairList)
};
}  // namespace detail

/// One group of a running scene: its columns, its records with their ghosts, and the cell grid in which others look for it.
template <class Item, class Layout_, class Precision>
class Group : public detail::Neighbourhood<Item::Dim, Layout_::has_pairs> {
 public:
  using Tag = typename Item::Tag;
  using Mobility = typename Item::Mobility;
  using Layout = Layout_;
  static constexpr int Dim = Item::Dim;
  using Columns = particles::Columns<Dim, typename Layout::columns>;
  using Records = particles::Records<Dim, typename Layout::record, Precision>;
  using Sums = particles::Sums<Dim, typename Layout::writes>;

  explicit Group(const Item& item) : name(item.name), mobility(item.mobility), mass(item.mass), spacing(item.points.spacing) {
    columns.resize(item.points.positions.size());
    positions().assign(item.points.positions.begin(), item.points.positions.end());
    if constexpr (contains<StartPosition, typename Layout::columns>) columns.template get<StartPosition>() = positions();
    id.resize(positions().size());
    for (std::size_t k = 0; k < id.size(); ++k) id[k] = static_cast<std::uint32_t>(k);
    constants.mass = mass;
    blocks = Blocks(size(), Dim);
    if constexpr (Layout::has_pairs) this->at_list_build = positions();
  }

  [[nodiscard]] std::size_t size() const noexcept { return id.size(); }
  /// Images of particles behind periodic faces, as of the last list build.
  [[nodiscard]] std::size_t ghost_count() const noexcept {
    if constexpr (Layout::has_pairs) return this->ghosts.size();
    return 0;
  }
  template <class Field>
  [[nodiscard]] auto& get() noexcept {
    static_assert(contains<Field, typename Layout::columns>, "dmp: this group has no such column: no law of the scene needs it");
    return columns.template get<Field>();
  }
  template <class Field>
  [[nodiscard]] const auto& get() const noexcept {
    static_assert(contains<Field, typename Layout::columns>, "dmp: this group has no such column: no law of the scene needs it");
    return columns.template get<Field>();
  }
  [[nodiscard]] auto& positions() noexcept { return columns.template get<field::Position>(); }
  [[nodiscard]] const auto& positions() const noexcept { return columns.template get<field::Position>(); }

  /// Sets a column from a function of the particle's position.
  template <class Field, class Function>
  void set(Function&& function) {
    auto& values = get<Field>();
    for (std::size_t k = 0; k < size(); ++k) values[k] = function(std::as_const(positions()[k]));
  }

  /// The group without its type.
  [[nodiscard]] particles::GroupView view() {
    particles::GroupView result{name, Mobility::name, Mobility::evolves, id, {}};
    for_each_field(typename Layout::columns{}, [&]<class Field>(Field) {
      auto& values = columns.template get<Field>();
      constexpr int components = Field::is_vector ? Dim : 1;
      constexpr bool positive = requires { Field::is_positive; };
      result.columns.push_back(
          {Field::name, Field::unit, components, {reinterpret_cast<double*>(values.data()), components * values.size()}, positive});
    });
    return result;
  }

  /// Rows of `records`: the particles, then rows far away from everything (PairList), then the ghosts.
  [[nodiscard]] std::size_t first_ghost() const noexcept { return blocks.far_row(blocks.size()); }
  /// What others list of this group.
  [[nodiscard]] neighbours::PairList::Sources sources(bool for_itself) const noexcept {
    return {for_itself, static_cast<std::uint32_t>(size()), static_cast<std::uint32_t>(first_ghost()), this->ghosts.owner,
            Precision::pairs_once};
  }

  /// View of record `index`, with the constants of the group, in all lanes.
  template <class T>
  [[nodiscard, gnu::always_inline]] auto spread(std::size_t index) const noexcept {
    View<Dim, T, typename Layout::seen> view;
    copy_fields(typename Layout::record{}, view, records.template spread<T>(index));
    spread_fields<T>(typename Layout::constants{}, view, constants);
    return view;
  }
  /// To be read by loops: views of the records index[0 .. width - 1], with the constants of the group.
  struct Reader {
    using Constants = typename Layout::constants;
    typename Records::Reader records;
    View<Dim, double, Constants> constants;

    /// The same with rows counted from `row`.
    [[nodiscard, gnu::always_inline]] Reader from(std::size_t row) const noexcept { return {records.from(row), constants}; }
    [[nodiscard, gnu::always_inline]] auto gather(const std::uint32_t* index) const noexcept {
      using Lanes = typename Records::Lanes;
      View<Dim, Lanes, typename Layout::seen> view;
      copy_fields(typename Layout::record{}, view, records.gather(index));
      spread_fields<Lanes>(Constants{}, view, constants);
      return view;
    }
    template <class Position>
    [[nodiscard, gnu::always_inline]] Position separation(const Position& i, const Position& j) const noexcept {
      return records.separation(i, j);
    }
  };
  [[nodiscard]] Reader reader() const noexcept { return {records.reader(), constants}; }
  /// Asks for what a sweep will want of a row: its neighbours are scattered, so that nothing else foretells it.
  [[gnu::always_inline]] void prefetch_for_sweep(std::size_t row) noexcept {
    if (row >= size()) return;
    __builtin_prefetch(records.data() + row * Records::stride, 0, 2);
    if constexpr (Layout::sums_in_memory && Precision::pairs_once) __builtin_prefetch(sums.data() + row * Sums::stride, 0, 2);
  }
  /// Asks for what a step will want of a row, in more places at once than processors foretell, anew in every page of memory.
  [[gnu::always_inline]] void prefetch_for_step(std::size_t row) noexcept {
    if (row >= size()) return;
    columns.prefetch(row);
    if constexpr (Layout::has_records) __builtin_prefetch(records.data() + row * Records::stride);
    if constexpr (Mobility::moves && Layout::has_pairs) __builtin_prefetch(&this->at_list_build[row]);
  }

  std::string name;
  Mobility mobility;
  double mass;     ///< of one particle [kg]
  double spacing;  ///< nearest distance at the start [m], 0 unknown
  Columns columns;
  std::vector<std::uint32_t> id;
  View<Dim, double, typename Layout::constants> constants;
  Records records;
  Sums sums;                  ///< what bonds, and pairs within a block, say of a particle, while its block is swept
  Blocks blocks;              ///< of the particles, and their division among the threads
  bool may_be_sorted = true;  ///< bonds hold rows, so bonded groups keep their order
};

}  // namespace dmp::simulation
