#pragma once

#include "api/ApiTypes.hpp"
#include "commands/CommandError.hpp"
#include "http/ApiFailure.hpp"
#include "http/ApiRequest.hpp"
#include "http/IApi.hpp"
#include "options/AcsctlOptions.hpp"
#include "view/ViewContext.hpp"
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// What a command that reads prints, and its exit code.
struct Shown
{
    std::string text;
    int exitCode = EXIT_DONE;
};

/// The error of an answer that cannot be decoded.
[[nodiscard]] tl::unexpected<CommandError> MakeBadAnswer(const Core::Error& error);

/// The clock of acsd when it made the answer: ages do not depend on the clock of this machine.
[[nodiscard]] Core::WallTime GetServerTime(const StatusInfo& status, Core::WallTime otherwise);

/// The body of an answer with status 2xx; otherwise the error that acsd states, with the exit code of the status.
[[nodiscard]] Outcome<std::string> GetBody(const ApiAnswer& answer);

/// The same of an answer that another address of acsd is to give; listenKey is its key in the configuration ("http.listen").
[[nodiscard]] Outcome<std::string> GetBodyFrom(std::string_view listenKey, const ApiAnswer& answer);

/// Sends a GET and returns the body of an answer with status 2xx.
[[nodiscard]] Outcome<std::string> Get(IApi& api, const std::string& target);

/// The error of a request without an answer; of a change it warns that acsd may have executed it.
[[nodiscard]] CommandError MakeError(const ApiFailure& failure, bool bChange);

/// The error that the answer to a change gave. Where the answer is not acsd's, unless its status shows that nothing was done (4xx),
/// it warns that acsd may have executed the change.
[[nodiscard]] CommandError MakeChangeError(const ApiAnswer& answer, CommandError error);

/// The lines for an answer to the GET of a command, or its JSON.
[[nodiscard]] Outcome<Shown> ShowAnswer(
    const AcsctlOptions& options,
    std::string_view body,
    const ViewContext& context);

/// The sentence of an accepted command, or its JSON.
[[nodiscard]] Outcome<Shown> ShowAccepted(bool bJSON, std::string_view body);

/// What is shown for the answer to a command that changes something; an error is that of MakeChangeError.
[[nodiscard]] Outcome<Shown> ShowChange(const AcsctlOptions& options, const ApiAnswer& answer);

} // namespace ACS::Acsctl
