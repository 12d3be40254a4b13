#include "operator/DescriptionRoute.hpp"

#include "common/http/HttpStaticFile.hpp"
#include "operator/DescriptionFiles.hpp"
#include "operator/OperatorAnswer.hpp"

#include <memory>
#include <optional>
#include <string>

namespace ACS::Acsd
{

void AddDescriptionRoute(Apps::HttpRoutes& routes)
{
    const auto file = std::make_shared<Apps::HttpStaticFile>("application/json", GetDescriptionFiles().front().content);
    routes.Add("GET", "/v1/openapi.json", [file](const Apps::HttpRequest& request, const auto&) {
        const std::optional<std::string> reason = FindUnexpectedParameterOrNull(request, {});
        return reason.has_value() ? MakeOperatorError(OperatorCode::BAD_REQUEST, *reason) : file->Respond(request);
    });
}

} // namespace ACS::Acsd
