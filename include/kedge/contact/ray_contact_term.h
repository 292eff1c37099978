#ifndef kedge_contact_ray_contact_term_h
#define kedge_contact_ray_contact_term_h

#include <kedge/contact/multiplier_pool.h>
#include <kedge/contact/ray_contact.h>

#include <set>

namespace kedge
{
  /**
   * Point-to-surface contact by ray tracing, with the augmented Lagrangian: Pretti (2024), section
   * 5.3.1.2. The outer faces of cells that points of the first body are in stand for its surface,
   * where the second field has their nodes too; Gauss points on them meet outer faces of the second
   * body's cells, R_A -= sum w N_A F,   R_B += sum w N_B(y) F,   sum w N_I C = 0, with
   * ray_contact() and multipliers that are linear along the faces. One-sided: the second body's
   * faces are met and ask for nothing. Faces and partners are those of the start of the step; what
   * depends on the displacements, normals and rays too, is in the tangent.
   */
  template <int dim>
  class RayContactTerm : public Term<dim>
  {
  public:
    /** Gauss points of a face in each direction. */
    static constexpr unsigned int n_gauss = 3;

    RayContactTerm(const std::string &pair, const ContactFields<dim> &fields, const RayLaw &law);

    std::string
    name() const override
    {
      return "contact '" + pair + "'";
    }

    void
    declare_unknowns(Unknowns<dim> &unknowns) override
    {
      multipliers.declare(unknowns);
    }

    void
    declare_books(Ledger &ledger) override;

    void
    reach(const unsigned int field, std::vector<unsigned char> &reached) override
    {
      multipliers.reach(field, reached);
    }

    void
    activate(const MaterialPoints<dim> &cloud) override;

    Answer
    add_residual(const Trial<dim> &trial, Residual<dim> &residual) override;

    void
    add_tangent(const Trial<dim> &trial, Tangent<dim> &tangent) override;

    void
    book(const Trial<dim> &trial, const Residual<dim> &residual, Ledger &ledger) const override;

    /** Faces on which contact is asked for in this step. */
    std::size_t
    n_faces() const
    {
      return faces.size();
    }

  private:
    static constexpr unsigned int n_corners = n_face_corners<dim>;
    /** Displacements of both faces' corners, multipliers. */
    static constexpr unsigned int n_values = 3 * n_corners * dim;
    using Corners                          = std::array<unsigned int, n_corners>;
    using Sloped                           = SlopedNumber<n_values>;
    using Cells                            = std::set<LatticeIndex<dim>>;
    using CornerNodes                      = std::array<LatticeIndex<dim>, n_corners>;
    using FaceUnknowns                     = std::array<UnknownIndex, n_values>;

    struct Face
    {
      Corners                    first, second; ///< local nodes of each field
      Corners                    multiplier;    ///< common node
      std::vector<RayPlace<dim>> places;
      std::vector<double>        areas; ///< that they stand for [m^2; m in 2D]
    };

    /** A side of a cell. */
    struct CellSide
    {
      LatticeIndex<dim> cell;
      int               direction, sign;
    };

    bool
    find_partner(const CellSide &side, const Cells &filled, CellSide &partner, int &ahead) const;
    CornerNodes
    nodes_of(const CellSide &side) const;
    void
    add_face(const CellSide &side, const Cells &filled);
    void
    set_places(const CellSide    &side,
               const CornerNodes &first,
               const CornerNodes &second,
               const int          ahead,
               Face              &face) const;
    template <typename Number, typename Make>
    RayState<dim, Number>
    state_of(const Face &face, const Trial<dim> &trial, const Make &make) const;
    RayState<dim, double>
    plain_state_of(const Face &face, const Trial<dim> &trial) const;
    /** The unknowns of a face in the order of Sloped; its multipliers with their factor. */
    FaceUnknowns
    unknowns_of(const Face &face) const;
    bool
    is_held(const Face &face, const unsigned int corner, const int d) const;

    const std::string        pair;
    const ContactFields<dim> fields;
    const RayLaw             law;
    MultiplierPool<dim>      multipliers;
    std::vector<Face>        faces;
    /** Of the window nodes that have multipliers: their number among them. */
    std::map<unsigned int, unsigned int> common;
    std::vector<bool>                    held; ///< multipliers along what holds both bodies

    struct Columns
    {
      Ledger::Index lost, friction, area, duration;
    };
    Columns             columns{};
    ResultantBooks<dim> resultant{};
  };
} // namespace kedge

#endif
