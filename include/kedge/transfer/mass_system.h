#ifndef kedge_transfer_mass_system_h
#define kedge_transfer_mass_system_h

#include <kedge/equations/node_matrix.h>
#include <kedge/fields/patch.h>

#include <functional>
#include <limits>

namespace kedge
{
  /** What a mass-like matrix acts on. */
  enum class MassVectors
  {
    velocities, ///< dim values per local node
    pressures   ///< dim + 1 values per local node of which the last one counts
  };

  /**
   * Equations of a mass-like matrix M, sum_p w N_A N_B with what penalties add to it:
   *   C^T M C x = b   at the free components,
   * all components alike. Mappings of velocities and pressures to the nodes are of this
   * kind. The matrix of well filled cells is so well conditioned that a few
   * conjugate-gradient iterations, scaled by the lumped matrix, solve it to round-off,
   * whatever its size; they leave small what the points do not determine.
   */
  template <int dim>
  class MassSystem
  {
  public:
    /** When conjugate gradients end. */
    struct Limits
    {
      double       residual; ///< scaled norm that suffices, see norm()
      unsigned int most_iterations;
      /** A longer step means an eigenvalue of the scaled matrix below its inverse: give up. */
      double longest_step = std::numeric_limits<double>::max();
      /** Asked once, before the iteration of this number: whether to go on. */
      unsigned int          ask_at = 0;
      std::function<bool()> go_on  = {};
    };

    explicit MassSystem(const MassVectors vectors)
      : vectors(vectors)
    {}

    /**
     * Takes a matrix; it and the patch must last as long as they are used.
     *
     * @param status one entry per value of the vectors; of pressures only the last of each
     *               node is read
     * @param new_pattern true if nodes or ties differ from the last call
     */
    void
    reinit(const Patch<dim>               &patch,
           const NodeMatrix<dim>          &matrix,
           const std::vector<NodalStatus> &status,
           const bool                      new_pattern);

    /** C^T M C x at the owned nodes (collective); what is tied or a ghost in @p x is set here. */
    void
    apply(std::vector<double> &x, std::vector<double> &product) const;

    /** (sum r^2 / lumped matrix)^(1/2) over the free components of all ranks (collective). */
    double
    norm(const std::vector<double> &residual) const;

    /**
     * Solves C^T M C correction = residual by conjugate gradients; false if they do not
     * get there (collective). The correction is what the last iteration has left.
     *
     * @param energy correction . residual, over all ranks
     */
    bool
    iterate(const Limits        &limits,
            std::vector<double>  residual,
            std::vector<double> &correction,
            double              &energy) const;

    /**
     * Improves @p x until the residual is @p tolerance of the right side's, or for a
     * number of iterations; tied components and ghosts are up to date then (collective).
     *
     * @param right_side restricted by the ties, at the owned nodes
     */
    void
    improve(const std::vector<double> &right_side,
            const double               tolerance,
            const unsigned int         most_iterations,
            std::vector<double>       &x) const;

  private:
    /** Values per node, and the first of those that count. */
    unsigned int
    n_values() const
    {
      return vectors == MassVectors::velocities ? dim : dim + 1;
    }
    unsigned int
    first_value() const
    {
      return vectors == MassVectors::velocities ? 0 : dim;
    }
    double
    scaled_square(const std::vector<double> &residual) const;
    double
    dot(const std::vector<double> &x, const std::vector<double> &y) const;

    const MassVectors         vectors;
    const Patch<dim>         *patch  = nullptr;
    const NodeMatrix<dim>    *matrix = nullptr;
    std::vector<unsigned int> neighbours;     ///< see node_neighbours()
    std::vector<double>       inverse_lumped; ///< of the matrix with its ties; 0 where not free
  };
} // namespace kedge

#endif
