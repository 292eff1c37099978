#ifndef kedge_surfaces_body_surface_h
#define kedge_surfaces_body_surface_h

#include <kedge/fields/patch.h>
#include <kedge/geometry/surface_mesh.h>
#include <kedge/grid/open_sides.h>
#include <kedge/surfaces/adapted_surface.h>
#include <kedge/surfaces/face_functions.h>

namespace kedge
{
  /**
   * The surface of a body, carried by it. A vertex moves by the displacements of the nodes of
   * its *root cell*, the nearest cell that the body fills well: by the polynomial of the grid's
   * functions in that cell (functions_of_cell()), continued to the vertex, dx = sum_I N_I(x) u_I,
   * sum_I N_I = 1,   sum_I N_I x_I = x. Rigid motions are therefore followed to round-off, and
   * forces that act on vertices come to the nodes with their resultant and their moment, and with
   * nothing for nodes that next to no mass belongs to. What a step tries is not kept here: move()
   * says where its end would bring the surface, commit() goes there. Facets that a step has
   * stretched are divided at its end, facets that it has drawn together become one (adapt()).
   *
   * Facets whose middle is beyond an open side of the grid have left it with their material, and so
   * have all once the body has no points left. They stay where they were and act on nothing.
   *
   * Every rank holds the whole surface. The nodes of a root cell, and with them the vertices that
   * follow it, are known to the rank that owns the cell; if claim_nodes() has been called, to all.
   */
  template <int dim>
  class BodySurface
  {
  public:
    /** Corners of a cell. */
    static constexpr unsigned int n_corners = 1u << dim;

    /**
     * Of the cells around a vertex, the nearest one filled to this part is its root. Small: a root
     * that changes to and fro as the body swings lets the surface drift off the body. Cells
     * that are filled by less hold nodes that are tied (NodeTies), whose motion is that of others.
     */
    static constexpr double well_filled = 0.1;

    /** In so many cells around a vertex a root is searched; without one the fullest serves. */
    static constexpr int search_radius = 2;

    /** @param field      number of the field, whose patch must last as long as this
     *  @param open_sides of the grid */
    BodySurface(const std::string    &body_name,
                const unsigned int    body,
                const unsigned int    field,
                const Patch<dim>     &patch,
                const OpenSides<dim> &open_sides = OpenSides<dim>())
      : body_name(body_name)
      , body(body)
      , field(field)
      , patch(patch)
      , open_sides(open_sides)
    {}

    /** Takes its vertices and facets; they are adapted to @p edges as the body moves. */
    void
    seed(const SurfaceMesh<dim> &seeded, const EdgeLengths &edges);

    /**
     * Flags the nodes of all root cells in the configuration that the patch has just read, one
     * entry per node of the window, so that this rank knows the nodes of all vertices (collective).
     */
    void
    claim_nodes(std::vector<unsigned char> &reached);

    /** Finds the root cells in the configuration that the patch has just read, and the facets that
     * have left (collective). */
    void
    find_roots();

    unsigned int
    n_vertices() const
    {
      return static_cast<unsigned int>(mesh().vertices.size());
    }

    unsigned int
    n_facets() const
    {
      return static_cast<unsigned int>(mesh().facets.size());
    }

    /** The committed places, and the facets. */
    const SurfaceMesh<dim> &
    mesh() const
    {
      return committed.mesh;
    }

    /** Corners of a facet at the start of the run [m]. */
    std::array<dealii::Point<dim>, dim>
    corners_at_start(const unsigned int facet) const
    {
      return committed.corners_at_start(facet);
    }

    /** Area of a facet at the start of the run [m^2; m in 2D]. */
    double
    reference_area(const unsigned int facet) const
    {
      return committed.reference_areas[facet];
    }

    /** Area of a facet now over that at the start of the run. */
    double
    stretch(const unsigned int facet) const
    {
      return area_vector<dim>(mesh().corners(facet)).norm() / reference_area(facet);
    }

    /** How often its facets have changed, other than by moving. */
    unsigned int
    generation() const
    {
      return generation_;
    }

    /** Values at the vertices of a nodal vector with dim components per local node (collective). */
    void
    interpolate(const std::vector<double>           &nodal,
                std::vector<dealii::Tensor<1, dim>> &at_vertices) const;

    /**
     * The last component of the unknowns of a saturated field, its pore pressure, at the
     * vertices [Pa] (collective).
     */
    void
    interpolate_pressure(const std::vector<double> &unknowns,
                         std::vector<double>       &at_vertices) const;

    /** Calls visit(local node, N) for the nodes of a vertex's root cell, if this rank owns it. */
    template <typename Visit>
    void
    for_nodes(const unsigned int vertex, const Visit &visit) const
    {
      if (owns(vertex))
        for_nodes_anywhere(vertex, visit);
    }

    /** Whether this rank owns a vertex's root cell. */
    bool
    owns(const unsigned int vertex) const
    {
      return is_own[vertex];
    }

    /** The same if this rank knows the root cell. */
    template <typename Visit>
    void
    for_nodes_anywhere(const unsigned int vertex, const Visit &visit) const
    {
      if (root_of_vertex[vertex] == elsewhere)
        return;
      for (unsigned int k = first_weight[vertex]; k < first_weight[vertex + 1]; ++k)
        visit(weights[k].node, weights[k].value);
    }

    /** A cell whose functions say how a place on the surface moves. */
    struct Root
    {
      LatticeIndex<dim> cell;
      bool              is_own   = false; ///< whether it is this rank's
      bool              is_known = false; ///< whether this rank knows its nodes
    };

    /** Calls visit(local node, N) with the functions of a root that is known, continued to x. */
    template <typename Visit>
    void
    for_functions(const Root &root, const dealii::Point<dim> &x, const Visit &visit) const;

    /**
     * The root of a place in a cell: the cell if points of the body are in it (nodes that it fills
     * badly are tied, so that a sliver moves as its root does), else that of a vertex.
     */
    Root
    root_at(const LatticeIndex<dim> &cell, const unsigned int nearest_vertex) const;

    /** Where a step would bring the vertices, and what would become of the facets. */
    void
    move(const std::vector<dealii::Tensor<1, dim>> &displacements);

    /** Of the facets that move() leads or has led to: what those before it remember goes over by
     * it. Empty if they are the same. */
    const FacetHeritage &
    heritage() const
    {
      return heritage_;
    }

    /** Goes to where move() has led. */
    void
    commit();

    /** What a checkpoint keeps of it, and takes back. */
    std::vector<double>
    save() const;

    void
    restore(const std::vector<double> &saved);

    const std::string  body_name;
    const unsigned int body;
    const unsigned int field;
    const Patch<dim>  &patch;

  private:
    /** A node's part in the motion of a vertex. */
    struct NodeWeight
    {
      unsigned int node; ///< local number
      double       value;
    };

    /** The root of a vertex whose nodes are not known to this rank. */
    static constexpr unsigned int elsewhere = static_cast<unsigned int>(-1);

    std::vector<double>
    fillings() const;
    void
    let_out(const std::vector<double> &filling);
    std::vector<bool>
    vertices_that_stay() const;
    Root
    root_of(const LatticeIndex<dim> &cell) const;
    LatticeIndex<dim>
    root_cell(const dealii::Point<dim>  &x,
              const std::vector<double> &filling,
              const int                  radius) const;

    const OpenSides<dim>      open_sides;
    EdgeLengths               edges;
    CarriedSurface<dim>       committed, moved;
    FacetHeritage             heritage_;
    unsigned int              generation_ = 0;
    std::vector<Root>         roots;      ///< of vertices, in use here
    std::vector<bool>         has_points; ///< cells of the window, of the body
    std::vector<unsigned int> root_of_vertex;
    std::vector<bool>         is_own;           ///< by vertex: the root cell is this rank's
    bool                      is_known = false; ///< claimed: roots of all vertices
    std::vector<unsigned int> first_weight;     ///< of each vertex, and the end
    std::vector<NodeWeight>   weights;
  };

  template <int dim>
  template <typename Visit>
  void
  BodySurface<dim>::for_functions(const Root               &root,
                                  const dealii::Point<dim> &x,
                                  const Visit              &visit) const
  {
    const auto functions = functions_of_cell<dim>(patch, patch.basis_of(body), root.cell, x);
    AssertThrow(functions, dealii::ExcInternalError());
    const auto first = patch.window().node_index(functions->first_node);
    int        n     = 1;
    for (int d = 0; d < dim; ++d)
      n *= stencil_width(functions->pattern, d);
    for (int A = 0; A < n; ++A)
      {
        LatticeIndex<dim> node  = first;
        double            value = 1.;
        for (int d = 0, rest = A; d < dim; ++d)
          {
            const int width = stencil_width(functions->pattern, d);
            node[d] += rest % width;
            value *= functions->value[d][rest % width];
            rest /= width;
          }
        visit(static_cast<unsigned int>(patch.nodes.local(patch.window().node_number(node))),
              value);
      }
  }
} // namespace kedge

#endif
