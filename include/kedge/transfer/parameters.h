#ifndef kedge_transfer_parameters_h
#define kedge_transfer_parameters_h

namespace kedge
{
  enum class VelocityUpdate
  {
    flip,
    pic
  };

  struct TransferParameters
  {
    VelocityUpdate velocity_mapping = VelocityUpdate::flip;
    double         lumping          = 0;     ///< epsilon of (3.161): 0 consistent, 1 lumped
    double         smallest_filling = 0.05;  ///< below, a node is tied (NodeTies) [cells]
    bool           audit            = false; ///< write what each mapping loses, Tables 3.1, 3.2
  };
} // namespace kedge

#endif
