#include <kedge/base/exceptions.h>
#include <kedge/io/collective.h>

#include <deal.II/base/mpi.h>

#include <string>

namespace kedge
{
  namespace
  {
    enum class Outcome : int
    {
      success,
      user_error,
      other_error
    };

    std::pair<Outcome, std::string>
    outcome_of(const std::function<void()> &action)
    {
      try
        {
          action();
        }
      catch (const UserError &error)
        {
          return {Outcome::user_error, error.what()};
        }
      catch (const std::exception &error)
        {
          return {Outcome::other_error, error.what()};
        }
      return {Outcome::success, ""};
    }

    void
    rethrow(const std::pair<Outcome, std::string> &outcome)
    {
      if (outcome.first == Outcome::user_error)
        throw UserError(outcome.second);
      if (outcome.first == Outcome::other_error)
        throw std::runtime_error(outcome.second);
    }
  } // namespace



  void
  run_on_root(const MPI_Comm communicator, const std::function<void()> &action)
  {
    std::pair<Outcome, std::string> outcome(Outcome::success, "");
    if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
      outcome = outcome_of(action);

    int kind = static_cast<int>(outcome.first);
    MPI_Bcast(&kind, 1, MPI_INT, 0, communicator);
    outcome.first = static_cast<Outcome>(kind);
    if (outcome.first != Outcome::success)
      outcome.second = dealii::Utilities::MPI::broadcast(communicator, outcome.second);
    rethrow(outcome);
  }



  void
  run_on_all(const MPI_Comm communicator, const std::function<void()> &action)
  {
    std::pair<Outcome, std::string> outcome = outcome_of(action);

    const unsigned int rank    = dealii::Utilities::MPI::this_mpi_process(communicator);
    const unsigned int n_ranks = dealii::Utilities::MPI::n_mpi_processes(communicator);
    const unsigned int failed =
      dealii::Utilities::MPI::min(outcome.first == Outcome::success ? n_ranks : rank, communicator);
    if (failed == n_ranks)
      return;

    int kind = static_cast<int>(outcome.first);
    MPI_Bcast(&kind, 1, MPI_INT, failed, communicator);
    outcome.first  = static_cast<Outcome>(kind);
    outcome.second = dealii::Utilities::MPI::broadcast(communicator, outcome.second, failed);
    rethrow(outcome);
  }
} // namespace kedge
