#include <kedge/equations/ledger.h>

#include <deal.II/base/exceptions.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace kedge
{
  const Ledger::Item *
  Ledger::find(const std::string &name) const
  {
    const auto found = std::find_if(items.begin(), items.end(), [&](const Item &item) {
      return item.entry.name == name;
    });
    return found == items.end() ? nullptr : &*found;
  }



  Ledger::Index
  Ledger::find_or_add(const Entry &entry)
  {
    if (const Item *known = find(entry.name))
      return static_cast<Index>(known - items.data());
    items.emplace_back();
    items.back().entry = entry;
    return static_cast<Index>(items.size()) - 1;
  }



  Ledger::Index
  Ledger::declare(const Entry &entry)
  {
    const Index whole = find_or_add(entry);
    if (part.empty() || !(entry.section == Section::energy || entry.section == Section::work ||
                          entry.section == Section::momentum))
      return whole;
    Entry of_part   = entry;
    of_part.section = Section::part;
    of_part.name += "_" + part;
    if (entry.role != Role::none)
      of_part.balance += "_" + part;
    const Index index        = find_or_add(of_part);
    items[index].whole_entry = whole;
    return index;
  }



  void
  Ledger::open_part(const std::string &name)
  {
    part = name;
  }



  void
  Ledger::close_part()
  {
    declare_stored("total_energy_" + part, "J", Section::part, "energy_" + part);
    declare_error("energy_error_" + part, "J", Section::part, "energy_" + part);
    part.clear();
  }



  void
  Ledger::declare_stored(const std::string &name,
                         const std::string &unit,
                         const Section      section,
                         const std::string &balance)
  {
    items.emplace_back();
    items.back().entry   = {name, unit, section, Kind::present, Role::none, balance};
    items.back().derived = Derived::stored;
  }



  void
  Ledger::declare_error(const std::string &name,
                        const std::string &unit,
                        const Section      section,
                        const std::string &balance)
  {
    items.emplace_back();
    items.back().entry   = {name, unit, section, Kind::present, Role::none, balance};
    items.back().derived = Derived::error;
  }



  void
  Ledger::open()
  {
    for (Item &item : items)
      item.booked = is_extreme(item) ? std::numeric_limits<double>::max() : 0.;
  }



  void
  Ledger::book(const Index entry, const double share)
  {
    Item &item = items[entry];
    if (is_extreme(item))
      item.booked = std::min(item.booked, sign_of_extreme(item) * share);
    else
      item.booked += share;
    if (item.whole_entry != no_entry)
      items[item.whole_entry].booked += share;
  }



  void
  Ledger::close(const MPI_Comm communicator)
  {
    std::vector<double> sums, lowest;
    for (const Item &item : items)
      (is_extreme(item) ? lowest : sums).push_back(item.booked);
    MPI_Allreduce(MPI_IN_PLACE,
                  sums.data(),
                  static_cast<int>(sums.size()),
                  MPI_DOUBLE,
                  MPI_SUM,
                  communicator);
    MPI_Allreduce(MPI_IN_PLACE,
                  lowest.data(),
                  static_cast<int>(lowest.size()),
                  MPI_DOUBLE,
                  MPI_MIN,
                  communicator);
    auto sum = sums.begin(), low = lowest.begin();
    for (Item &item : items)
      {
        double booked = is_extreme(item) ? sign_of_extreme(item) * *low++ : *sum++;
        if (is_extreme(item) && std::abs(booked) == std::numeric_limits<double>::max())
          booked = 0.; // nobody had anything: a scene without material points
        item.value          = item.entry.kind == Kind::total ? item.value + booked : booked;
      }
  }



  void
  Ledger::set_start()
  {
    for (Item &item : items)
      item.start = item.entry.role == Role::stored ? item.value : 0.;
  }



  double
  Ledger::stored(const std::string &balance) const
  {
    double sum = 0.;
    for (const Item &item : items)
      if (item.entry.role == Role::stored && item.entry.balance == balance)
        sum += item.value;
    return sum;
  }



  double
  Ledger::error(const std::string &balance) const
  {
    double start = 0., lost = 0., supplied = 0.;
    for (const Item &item : items)
      if (item.entry.balance == balance)
        {
          start += item.start;
          if (item.entry.role == Role::lost)
            lost += item.value;
          if (item.entry.role == Role::supplied)
            supplied += item.value;
        }
    return stored(balance) + lost - start - supplied;
  }



  double
  Ledger::value(const Item &item) const
  {
    switch (item.derived)
      {
        case Derived::stored:
          return stored(item.entry.balance);
        case Derived::error:
          return error(item.entry.balance);
        default:
          return item.value;
      }
  }



  double
  Ledger::value_or(const std::string &column, const double otherwise) const
  {
    const Item *item = find(column);
    return item != nullptr ? value(*item) : otherwise;
  }



  double
  Ledger::value(const std::string &column) const
  {
    const Item *item = find(column);
    AssertThrow(item != nullptr, dealii::ExcMessage("The ledger has no column " + column + "."));
    return value(*item);
  }



  std::vector<const Ledger::Item *>
  Ledger::in_order() const
  {
    std::vector<const Item *> result;
    for (const Item &item : items)
      result.push_back(&item);
    std::stable_sort(result.begin(), result.end(), [](const Item *a, const Item *b) {
      return a->entry.section < b->entry.section;
    });
    return result;
  }



  std::vector<Ledger::Column>
  Ledger::columns() const
  {
    std::vector<Column> result;
    for (const Item *item : in_order())
      result.push_back(
        {item->entry.name, item->entry.unit, item->entry.section, item->entry.whole});
    return result;
  }



  std::vector<double>
  Ledger::values() const
  {
    std::vector<double> result;
    for (const Item *item : in_order())
      result.push_back(value(*item));
    return result;
  }



  std::map<std::string, double>
  Ledger::save() const
  {
    std::map<std::string, double> result;
    for (const Item &item : items)
      {
        if (item.entry.kind == Kind::total)
          result[item.entry.name] = item.value;
        if (item.entry.role == Role::stored)
          result[item.entry.name + " at the start"] = item.start;
      }
    return result;
  }



  void
  Ledger::restore(const std::map<std::string, double> &saved)
  {
    const auto read = [&](const std::string &name) {
      const auto found = saved.find(name);
      AssertThrow(found != saved.end(),
                  dealii::ExcMessage("The checkpoint has no value for " + name + "."));
      return found->second;
    };
    for (Item &item : items)
      {
        if (item.entry.kind == Kind::total)
          item.value = read(item.entry.name);
        if (item.entry.role == Role::stored)
          item.start = read(item.entry.name + " at the start");
      }
  }
} // namespace kedge
