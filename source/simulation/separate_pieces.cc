#include <kedge/base/exceptions.h>
#include <kedge/simulation/separate_pieces.h>

namespace kedge
{
  namespace
  {
    /** @throws UserError if an entry of @p list names @p body. */
    template <class List>
    void
    refuse_names(const List &list, const std::string &section, const std::string &body)
    {
      for (const auto &entry : list)
        if (entry.body == body)
          throw UserError("Bodies/" + body + "/Pieces = apart makes bodies of their own of its " +
                          "pieces, and " + section + "/" + entry.name +
                          " does not say which it means. Write them as bodies of their own, which "
                          "a section Contact sets apart.");
    }

    template <int dim>
    void
    check_names(const Scene<dim> &scene, const std::string &body)
    {
      refuse_names(scene.node_conditions, "Node conditions", body);
      refuse_names(scene.body_conditions, "Body conditions", body);
      refuse_names(scene.tractions, "Tractions", body);
      refuse_names(scene.point_loads, "Point loads", body);
      refuse_names(scene.surface_pressures, "Surface pressures", body);
      refuse_names(scene.surface_fluxes, "Surface fluxes", body);
      refuse_names(scene.probes, "Probes", body);
    }

    void
    replace_in(std::vector<std::string>       &group,
               const std::string              &body,
               const std::vector<std::string> &pieces)
    {
      std::vector<std::string> result;
      for (const std::string &name : group)
        if (name == body)
          result.insert(result.end(), pieces.begin(), pieces.end());
        else
          result.push_back(name);
      group = result;
    }
  } // namespace



  template <int dim>
  Scene<dim>
  with_separate_pieces(Scene<dim> scene)
  {
    const auto whole = scene.bodies;
    const auto pores = scene.pore_fluid ? scene.pore_fluid->bodies : std::vector<BodyPores>();
    scene.bodies.clear();
    if (scene.pore_fluid)
      scene.pore_fluid->bodies.clear();
    for (std::size_t b = 0; b < whole.size(); ++b)
      {
        std::vector<std::string> names;
        const std::size_t        n = whole[b].pieces.size();
        for (std::size_t k = 0; k < std::max<std::size_t>(n, 1); ++k)
          {
            BodyParameters<dim> piece = whole[b];
            if (n > 1)
              {
                piece.geometry = piece.pieces[k];
                piece.piece_of = piece.name;
                piece.name += " " + std::to_string(k + 1);
              }
            piece.pieces.clear();
            names.push_back(piece.name);
            scene.bodies.push_back(piece);
            if (scene.pore_fluid)
              scene.pore_fluid->bodies.push_back(pores[b]);
          }
        if (n < 2)
          continue;
        check_names(scene, whole[b].name);
        for (ContactParameters &contact : scene.contacts)
          for (auto *group : {&contact.first, &contact.second})
            replace_in(*group, whole[b].name, names);
      }
    return scene;
  }

  template Scene<2> with_separate_pieces(Scene<2>);
  template Scene<3> with_separate_pieces(Scene<3>);
} // namespace kedge
