#include <kedge/materials/material.h>

#include <algorithm>

namespace kedge
{
  namespace
  {
    template <std::size_t... i>
    std::vector<Column>
    collect_columns(std::index_sequence<i...>)
    {
      std::vector<Column> result;
      const auto          add = [&](const Column &column) {
        const bool known = std::any_of(result.begin(), result.end(), [&](const Column &other) {
          return std::string(other.name) == column.name;
        });
        if (!known && column.kind != ColumnKind::volume_strain &&
            column.kind != ColumnKind::time_step)
          result.push_back(column);
      };
      const auto add_all = [&](const auto &columns) {
        for (const Column &column : columns)
          add(column);
      };
      (add_all(std::variant_alternative_t<i, Material>::columns), ...);
      return result;
    }
  } // namespace



  std::vector<Column>
  columns_of(const Material &material)
  {
    return std::visit(
      [](const auto &m) {
        using Law = std::decay_t<decltype(m)>;
        return std::vector<Column>(Law::columns.begin(), Law::columns.end());
      },
      material);
  }



  const std::vector<Column> &
  memory_columns()
  {
    static const std::vector<Column> columns =
      collect_columns(std::make_index_sequence<std::variant_size_v<Material>>());
    return columns;
  }



  unsigned int
  memory_index(const std::string &name)
  {
    const auto &columns = memory_columns();
    return std::find_if(columns.begin(),
                        columns.end(),
                        [&](const Column &column) {
                          return column.name == name;
                        }) -
           columns.begin();
  }



  std::vector<unsigned int>
  memory_indices(const Material &material)
  {
    std::vector<unsigned int> result;
    for (const Column &column : columns_of(material))
      result.push_back(column.kind == ColumnKind::volume_strain ? not_in_memory
                       : column.kind == ColumnKind::time_step   ? is_time_step
                                                                : memory_index(column.name));
    return result;
  }



  std::vector<const SpatialConstant *>
  constants_of_place(const Material &material, const MaterialParameters &parameters)
  {
    return std::visit(
      [&](const auto &m) {
        const auto constants = m.constants(parameters);
        return std::vector<const SpatialConstant *>(constants.begin(), constants.end());
      },
      material);
  }



  std::vector<double>
  start_history(const Material &material, const MaterialParameters &parameters)
  {
    std::vector<double> result;
    for (const SpatialConstant *constant : constants_of_place(material, parameters))
      result.push_back(constant == nullptr ? 0. : constant->value);
    return result;
  }
} // namespace kedge
