#include <fmt/format.h>

#include <memory>

#include "cli/commands.hpp"
#include "cli/film_store.hpp"
#include "cli/film_subject.hpp"
#include "cli/help.hpp"
#include "cli/images.hpp"
#include "cli/options.hpp"
#include "cli/request.hpp"
#include "scene/settings.hpp"
#include "wavefront/develop.hpp"

namespace orrery {
namespace {

constexpr const char* example =
    "Example: two machines render an image\n"
    "  {0} render scenes/assignment_08.json --shard 1/2 --film 1.film\n"
    "  {0} render scenes/assignment_08.json --shard 2/2 --film 2.film\n"
    "  {0} develop 1.film 2.film -o image.png -o image.exr\n"
    "\n"
    "Standard output names the images written, one on a line. Exit code: 0 written, 1 the work failed, 2 bad usage or "
    "films that do not belong together.";

struct Developed {
    Request request;
    bool unfinished = false;
};

int develop_films(const Developed& asked) {
    const Request& request = asked.request;
    FilmSubject subject;
    const std::unique_ptr<Ledger> ledger = join_films(request.films, asked.unfinished, subject);
    const Film& film = ledger->film();
    Making making = making_of(subject);
    for (const auto& [setting, value] : request.overrides) setting->member.set(making.settings, value);
    making.exposure = request.exposure.value_or(making.exposure);
    const Window window = making.settings.window();
    if (window.width() != film.width() || window.height() != film.height())
        throw std::runtime_error(
            fmt::format("{}: damaged: it is not of the size it says", request.films.front().string()));
    making.samples = ledger->samples().mean();
    const Outputs outputs = choose_outputs(request, making.settings, request.films);
    require_writable(outputs, making.settings);

    Team team(request.threads);
    const std::function<bool()> never;
    const Cancellation cancellation(never);
    const Developing how{team, cancellation};
    const Integrator integrator = making.settings.integrator;
    const Image image = develop(film, integrator, how);
    const Image errors = develop_error(film, integrator, how);
    if (!request.quiet)
        print_line(fmt::format("{}: {} x {}, {}", making.scene, film.width(), film.height(),
                               film_summary(making.samples, estimate_error(film, integrator, image, errors, how))));

    const auto written = write_images(outputs, image, errors, making);
    for (const auto& file : written) print_name(file);
    return written.size() == outputs.images.size() + (outputs.error_image ? 1 : 0) ? exit_code::done
                                                                                   : exit_code::failed;
}

}  // namespace

Work add_develop(CLI::App& app) {
    const auto asked = std::make_shared<Developed>();
    Request& request = asked->request;
    app.add_option("FILM", request.films, "Films that render --film has kept: one, or those of all shards of an image")
        ->type_name("FILE...")
        ->required()
        ->group("Films");
    app.add_flag("--unfinished", asked->unfinished, "Make an image of what there is, black where there is nothing yet")
        ->group("Films");
    add_outputs(app, request, "");
    add_override(app, request.overrides, setting("tonemap"), "the render's");
    add_exposure(app, request, "the render's");
    add_error_image(app, request);
    add_quiet(app, request.quiet);
    app.footer(fmt::format(example, typed_command()));
    return [asked] { return develop_films(*asked); };
}

}  // namespace orrery
