#include "operator/PageRoutes.hpp"

#include "common/http/HttpStaticFile.hpp"
#include "operator/OperatorAnswer.hpp"
#include "operator/PageFiles.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view FIRST_PAGE = "index.html";

using PageFiles = std::map<std::string, Apps::HttpStaticFile, std::less<>>;

std::string_view GetContentType(std::string_view name)
{
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> TYPES{{
        {".html", "text/html; charset=utf-8"},
        {".css", "text/css; charset=utf-8"},
        {".js", "text/javascript; charset=utf-8"},
        {".json", "application/json"},
        {".svg", "image/svg+xml"},
    }};
    const auto* const type =
        std::ranges::find_if(TYPES, [name](const auto& known) { return name.ends_with(known.first); });
    return type == TYPES.end() ? "text/plain; charset=utf-8" : type->second;
}

Apps::HttpResponse RespondWithFile(const PageFiles& files, const Apps::HttpRequest& request, std::string_view name)
{
    const auto file = files.find(name);
    return file == files.end()
        ? MakeOperatorError(OperatorCode::NOT_FOUND, fmt::format("The page has no file {}.", Core::QuoteForError(name)))
        : file->second.Respond(request);
}

} // namespace

void AddPageRoutes(Apps::HttpRoutes& routes)
{
    const auto files = std::make_shared<PageFiles>();
    for (const EmbeddedFile& file : GetPageFiles())
    {
        files->try_emplace(std::string(file.name), GetContentType(file.name), file.content);
    }
    routes.Add("GET", "/", [files](const Apps::HttpRequest& request, const auto&) {
        return RespondWithFile(*files, request, FIRST_PAGE);
    });
    routes.Add(
        "GET",
        "/page/{NAME}",
        [files](const Apps::HttpRequest& request, const Apps::HttpRoutes::Captures& captures) {
            return RespondWithFile(*files, request, captures.front());
        });
}

} // namespace ACS::Acsd
