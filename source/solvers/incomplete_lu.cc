#include "incomplete_lu.h"

#include "foreign_rows.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace kedge
{
  namespace
  {
    /** Blocks with no entry above this, where diagonals are 1, are left out. */
    constexpr double threshold = 0.02;

    /** Diagonal blocks with a pivot below this are replaced with the identity. */
    constexpr double smallest_pivot = 1e-3;

    /** The registers that hold a column of n entries. */
    template <int n>
    struct Registers;

    template <>
    struct Registers<2>
    {
      using Doubles = double __attribute__((vector_size(16)));
      using Floats  = float __attribute__((vector_size(8)));

      static Doubles
      widened(const Floats a)
      {
        return Doubles{a[0], a[1]};
      }
    };

    template <>
    struct Registers<3>
    {
      using Doubles = double __attribute__((vector_size(32)));
      using Floats  = float __attribute__((vector_size(16)));

      /** One instruction of the processor, which __builtin_convertvector is not. */
      static Doubles
      widened(const Floats a)
      {
        return Doubles{a[0], a[1], a[2], a[3]};
      }
    };

    /** Small dense blocks, a column in a register. */
    template <int n>
    struct Blocks
    {
      using Doubles = typename Registers<n>::Doubles;
      using Floats  = typename Registers<n>::Floats;
      using Block   = std::array<Doubles, n>;
      using Stored  = std::array<Floats, n>;

      static Block
      widened(const Stored &a)
      {
        Block b;
        for (int c = 0; c < n; ++c)
          b[c] = Registers<n>::widened(a[c]);
        return b;
      }

      static Stored
      rounded(const Block &a)
      {
        Stored b;
        for (int c = 0; c < n; ++c)
          b[c] = __builtin_convertvector(a[c], Floats);
        return b;
      }

      static Block
      product(const Block &a, const Block &b)
      {
        Block result;
        for (int c = 0; c < n; ++c)
          {
            result[c] = a[0] * b[c][0];
            for (int k = 1; k < n; ++k)
              result[c] += a[k] * b[c][k];
          }
        return result;
      }

      static void
      subtract_product(const Block &a, const Stored &b, Block &from)
      {
        for (int c = 0; c < n; ++c)
          for (int k = 0; k < n; ++k)
            from[c] -= a[k] * static_cast<double>(b[c][k]);
      }

      /** By Gauss and Jordan; the identity if a pivot is small. */
      static Block
      inverse(Block a)
      {
        Block result{};
        for (int c = 0; c < n; ++c)
          result[c][c] = 1.;
        const Block identity = result;
        for (int p = 0; p < n; ++p)
          {
            if (!(std::abs(a[p][p]) > smallest_pivot))
              return identity;
            const Doubles factors = a[p] / a[p][p];
            const auto    reduce  = [&](Doubles &column) {
              const double pivot = column[p];
              column -= factors * pivot;
              column[p] = pivot / a[p][p];
            };
            for (int c = 0; c < n; ++c)
              {
                reduce(result[c]);
                if (c > p)
                  reduce(a[c]);
              }
          }
        return result;
      }
    };



    template <int n>
    class BlockIncompleteLu : public IncompleteLu
    {
    public:
      explicit BlockIncompleteLu(const double damping)
        : damping(damping)
      {}

      void
      reinit(const DistributedMatrix &matrix) override
      {
        overlap.reinit(matrix);
        find_nodes(matrix);
      }

      void
      factorise(const DistributedMatrix &matrix) override
      {
        overlap.get_values(matrix);
        const int n_nodes = static_cast<int>(first_row.size()) - 1;
        row_start.assign(1, 0);
        diagonal.resize(n_nodes);
        column.clear();
        value.clear();
        place.assign(n_nodes, -1);
        for (int i = 0; i < n_nodes; ++i)
          {
            copy_large_blocks(matrix, i);
            eliminate(i);
          }
      }

      void
      multiply(const DistributedMatrix &matrix, const double *x, double *y) override
      {
        const int n_nodes = static_cast<int>(diagonal.size());
        const int n_rows  = static_cast<int>(matrix.n_rows());
        extended.resize(first_row.back());
        std::copy(x, x + n_rows, extended.begin());
        matrix.exchange(extended.data());
        padded.resize(n_nodes);
        for (int i = 0; i < n_nodes; ++i)
          {
            Doubles sum{};
            for (int row = first_row[i]; row < first_row[i + 1]; ++row)
              sum[row - first_row[i]] = extended[row];
            padded[i] = sum - product(row_start[i], diagonal[i]);
          }
        for (int i = n_nodes - 1; i >= 0; --i)
          {
            const Doubles rest    = padded[i] - product(diagonal[i] + 1, row_start[i + 1]);
            const Block   inverse = B::widened(value[diagonal[i]]);
            padded[i]             = inverse[0] * rest[0];
            for (int c = 1; c < n; ++c)
              padded[i] += inverse[c] * rest[c];
            if (first_row[i] < n_rows)
              for (int row = first_row[i]; row < first_row[i + 1]; ++row)
                y[row] = padded[i][row - first_row[i]];
          }
      }

    private:
      using B       = Blocks<n>;
      using Block   = typename B::Block;
      using Doubles = typename B::Doubles;

      /** Rows of the same columns belong to a node; this rank's come first. */
      void
      find_nodes(const DistributedMatrix &matrix)
      {
        const int n_rows = static_cast<int>(matrix.n_rows());
        first_row.clear();
        for (const auto &group : matrix.row_groups())
          for (unsigned int k = 0; k < group.n_rows; k += n)
            first_row.push_back(static_cast<int>(group.first_row + k));
        const auto foreign_row = [&](const int row) {
          return overlap.column.begin() + overlap.row_start[row];
        };
        for (int row = 0; row < static_cast<int>(matrix.n_foreign()); ++row)
          {
            const int first = first_row.empty() ? 0 : first_row.back() - n_rows;
            if (first < 0 || row == 0 || row - first >= n ||
                !std::equal(foreign_row(first),
                            foreign_row(first + 1),
                            foreign_row(row),
                            foreign_row(row + 1)))
              first_row.push_back(n_rows + row);
          }
        first_row.push_back(n_rows + static_cast<int>(matrix.n_foreign()));
        node_of_row.resize(first_row.back());
        for (unsigned int node = 0; node + 1 < first_row.size(); ++node)
          for (int row = first_row[node]; row < first_row[node + 1]; ++row)
            node_of_row[row] = static_cast<int>(node);
      }

      /** The rows of a node one behind the other. */
      struct NodeRows
      {
        const int    *columns;
        const double *entries;
        std::int64_t  length;
      };

      NodeRows
      rows_of_node(const DistributedMatrix &matrix, const int i) const
      {
        const int  row = first_row[i], foreign = row - static_cast<int>(matrix.n_rows());
        const auto rows =
          [](const auto &start, const int *column, const double *value, const int r) {
            return NodeRows{column + start[r], value + start[r], start[r + 1] - start[r]};
          };
        return foreign < 0
                 ? rows(matrix.values().row_start,
                        matrix.columns(),
                        matrix.values().value.data(),
                        row)
                 : rows(overlap.row_start, overlap.column.data(), overlap.value.data(), foreign);
      }

      /** Puts row i's blocks that matter into the present row, the diagonal one in any case. */
      void
      copy_large_blocks(const DistributedMatrix &matrix, const int i)
      {
        const auto [columns, entries, length] = rows_of_node(matrix, i);
        const int     begin = first_row[i], n_rows = first_row[i + 1] - begin;
        const double *scale = matrix.scaling().data();
        present.clear();
        present_column.clear();
        for (std::int64_t k = 0, next = 0; k < length; k = next)
          {
            const int node = node_of_row[columns[k]], first = first_row[node];
            for (next = k + 1; next < length && node_of_row[columns[next]] == node;)
              ++next;
            Block  block;
            double largest = 0.;
            if (n_rows == n && next == k + n)
              largest = copy_block(entries + k, length, scale + begin, scale + first, block);
            else
              {
                block = Block{};
                for (std::int64_t q = k; q < next; ++q)
                  for (int row = 0; row < n_rows; ++row)
                    {
                      const double entry =
                        scale[begin + row] * scale[columns[q]] * entries[row * length + q];
                      block[columns[q] - first][row] = entry;
                      largest                        = std::max(largest, std::abs(entry));
                    }
              }
            if (node == i || largest > threshold)
              add_block(node, block);
          }
        complete_diagonal(i);
        sort_present();
      }

      /** Ones where the diagonal has nothing, also in the lanes that no row needs. */
      void
      complete_diagonal(const int i)
      {
        auto place_of_diagonal = std::find(present_column.begin(), present_column.end(), i);
        if (place_of_diagonal == present_column.end())
          {
            add_block(i, Block{});
            place_of_diagonal = present_column.end() - 1;
          }
        Block &block = present[place_of_diagonal - present_column.begin()];
        for (int c = 0; c < n; ++c)
          if (c >= first_row[i + 1] - first_row[i] || block[c][c] == 0.)
            block[c][c] = 1.;
          else
            block[c][c] += damping;
      }

      /** By columns, which are in order but for those of other ranks. */
      void
      sort_present()
      {
        if (std::is_sorted(present_column.begin(), present_column.end()))
          return;
        std::vector<std::pair<int, Block>> pairs;
        for (std::size_t k = 0; k < present.size(); ++k)
          pairs.emplace_back(present_column[k], present[k]);
        std::sort(pairs.begin(), pairs.end(), [](const auto &a, const auto &b) {
          return a.first < b.first;
        });
        for (std::size_t k = 0; k < present.size(); ++k)
          std::tie(present_column[k], present[k]) = pairs[k];
      }

      /** A complete block, scaled; returns its largest entry. */
      static double
      copy_block(const double      *entries,
                 const std::int64_t length,
                 const double      *row_scale,
                 const double      *column_scale,
                 Block             &block)
      {
        double largest = 0.;
        for (int c = 0; c < n; ++c)
          {
            Doubles column{};
            for (int row = 0; row < n; ++row)
              column[row] = row_scale[row] * column_scale[c] * entries[row * length + c];
            for (int row = 0; row < n; ++row)
              largest = std::max(largest, std::abs(column[row]));
            block[c] = column;
          }
        return largest;
      }

      void
      add_block(const int node, const Block &block)
      {
        present_column.push_back(node);
        present.push_back(block);
      }

      /** Makes the present row one of L and U. */
      void
      eliminate(const int i)
      {
        const int n_present = static_cast<int>(present.size());
        for (int k = 0; k < n_present; ++k)
          place[present_column[k]] = k;
        for (int k = 0; k < n_present; ++k)
          {
            const int j = present_column[k];
            if (j == i)
              {
                diagonal[i] = row_start[i] + k;
                present[k]  = B::inverse(present[k]);
              }
            else if (j < i)
              {
                present[k] = B::product(present[k], B::widened(value[diagonal[j]]));
                for (std::int64_t q = diagonal[j] + 1; q < row_start[j + 1]; ++q)
                  if (place[column[q]] >= 0)
                    B::subtract_product(present[k], value[q], present[place[column[q]]]);
              }
            column.push_back(j);
            value.push_back(B::rounded(present[k]));
          }
        for (int k = 0; k < n_present; ++k)
          place[present_column[k]] = -1;
        row_start.push_back(static_cast<std::int64_t>(column.size()));
      }

      /** Of the blocks from begin to end of a row and what is solved for so far. */
      Doubles
      product(const std::int64_t begin, const std::int64_t end) const
      {
        Block sums{};
        for (std::int64_t k = begin; k < end; ++k)
          {
            const Doubles x     = padded[column[k]];
            const Block   block = B::widened(value[k]);
            for (int c = 0; c < n; ++c)
              sums[c] += block[c] * x[c];
          }
        Doubles sum = sums[0];
        for (int c = 1; c < n; ++c)
          sum += sums[c];
        return sum;
      }

      const double                    damping;
      ForeignRows                     overlap;
      std::vector<int>                first_row; ///< of each node, and the number of rows
      std::vector<int>                node_of_row;
      std::vector<std::int64_t>       row_start, diagonal;
      std::vector<int>                column;
      std::vector<typename B::Stored> value; ///< L, the inverse diagonal blocks, U
      std::vector<Block>              present;
      std::vector<int>     present_column, place; ///< of a column in the present row, or -1
      std::vector<Doubles> padded;
      std::vector<double>  extended; ///< with other ranks' rows
    };
  } // namespace

  std::unique_ptr<IncompleteLu>
  make_incomplete_lu(const int block_size, const double damping)
  {
    if (block_size == 2)
      return std::make_unique<BlockIncompleteLu<2>>(damping);
    return std::make_unique<BlockIncompleteLu<3>>(damping);
  }
} // namespace kedge
