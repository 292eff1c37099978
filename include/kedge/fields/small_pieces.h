#ifndef kedge_fields_small_pieces_h
#define kedge_fields_small_pieces_h

#include <kedge/fields/step_points.h>

namespace kedge
{
  /**
   * Pieces of material on the grid: nodes belong to one piece if points reach them together,
   * or a chain of points does. Pieces do not share any node; they cannot feel each other.
   */
  struct Pieces
  {
    static constexpr unsigned int none = static_cast<unsigned int>(-1);

    std::vector<unsigned int> of_node;  ///< number of the piece of each window node, or none
    std::vector<unsigned int> n_points; ///< of each piece, on all ranks
  };

  /** The value of a node as the sum of others. */
  struct NodeSum
  {
    unsigned int              node; ///< of the window, as the roots
    std::vector<unsigned int> roots;
    std::vector<double>       weights;
  };

  /**
   * Finds the pieces (collective).
   *
   * @param hanging nodes that join their roots to a piece
   */
  template <int dim>
  Pieces
  find_pieces(const BackgroundGrid<dim>  &grid,
              const StepPoints<dim>      &points,
              const std::vector<NodeSum> &hanging = {});

  /**
   * Gives the nodes that are @p left, badly filled ones without a well-filled cell of their piece
   * nearby, as much freedom as few points can bear: the fullest cell among them becomes
   * a root, whose corners move freely, and the others nearby continue its multilinear field; with
   * what is left, the same again. A piece of fewer than 2^dim points moves as an affine body:
   * then the corners follow from dim + 1 of them. Linear fields are exact, so that both momenta are
   * kept as by any other tie.
   *
   * @param volume of material at the window's nodes; 0 where none is
   * @param is_tied nodes that are tied already: they are no corners of roots
   * @param edge of a cell, in intervals of the lattice
   * @param reach how far a root carries, in cells
   */
  template <int dim>
  std::vector<NodeSum>
  tie_small_pieces(const LatticeWindow<dim>        &window,
                   const std::vector<double>       &volume,
                   const Pieces                    &pieces,
                   const std::vector<bool>         &is_tied,
                   const std::vector<unsigned int> &left,
                   const int                        edge,
                   const int                        reach);
} // namespace kedge

#endif
