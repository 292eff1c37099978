#ifndef kedge_finite_element_output_h
#define kedge_finite_element_output_h

#include "solid.h"

#include <kedge/io/csv_file.h>

namespace finite_element
{
  /**
   * Writes history.csv, probes.csv and summary.json with the names that kedge
   * gives to the same things, so that one program can read both.
   */
  class Output
  {
  public:
    /** @throws kedge::UserError if the folder cannot be written. */
    Output(const Parameters &parameters, const Solid &solid, const std::string &folder);

    /** A row of both tables. */
    void
    write_step(const Solid        &solid,
               const std::uint64_t step,
               const double        time,
               const double        dt,
               const unsigned int  iterations);

    /** summary.json; @p reason is empty if the run has finished. */
    void
    write_summary(const Parameters &parameters, const Solid &solid, const std::string &reason);

    std::uint64_t n_rejected = 0;

  private:
    /** Weights of the displacements of nodes; places are deal.II's dofs per component. */
    struct Probe
    {
      dealii::Point<dim>                                              place;
      std::vector<std::pair<dealii::types::global_dof_index, double>> weights[dim];
    };

    static Probe
    face_probe(const Solid &solid, const int side);
    static Probe
    point_probe(const Solid &solid, const dealii::Point<dim> &place);

    std::string        folder;
    std::vector<Probe> probes;
    kedge::CsvFile     history, probe_table;
    double             initial_energy;
    std::uint64_t      n_steps = 0, n_iterations = 0;
  };
} // namespace finite_element

#endif
