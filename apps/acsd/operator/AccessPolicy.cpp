#include "operator/AccessPolicy.hpp"

#include "common/config/Endpoint.hpp"
#include "common/config/WordReader.hpp"
#include "common/http/HttpGuard.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
#include <cassert>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using EAccess = AccessPolicy::EAccess;
using EProof = OperatorIdentity::EProof;

/// Schemes are case-insensitive (RFC 9110 section 11.1).
bool IsBearer(std::string_view scheme)
{
    const auto lower = [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    };
    return std::ranges::equal(scheme, std::string_view("bearer"), {}, lower);
}

bool IsReading(const Apps::HttpRequest& request)
{
    return request.method == "GET" || request.method == "HEAD";
}

} // namespace

AccessPolicy::AccessPolicy(Options options)
    : _options(std::move(options))
{
}

std::string_view GetText(EProof proof)
{
    switch (proof)
    {
        case EProof::Local:
            return "local";
        case EProof::Token:
            return "token";
        case EProof::Session:
            return "session";
        case EProof::Certificate:
            return "certificate";
        default:
            assert(false);
            return {};
    }
}

bool AccessPolicy::IsPublic(const Apps::HttpRequest& request)
{
    const bool bOfPage = request.path == "/" || (request.segments.size() > 1 && request.segments.front() == "page");
    return bOfPage && IsReading(request);
}

bool AccessPolicy::HasTokens() const noexcept
{
    return _options.tokens.has_value();
}

AccessPolicy::Decision AccessPolicy::Decide(
    const Apps::HttpRequest& request,
    const std::optional<OperatorToken::Hash>& sessionOrNull) const
{
    Decision decision = Identify(request.sender, sessionOrNull);
    if (decision.access != EAccess::Permitted || IsReading(request))
    {
        return decision;
    }
    if (decision.identity->role == EOperatorRole::Viewer)
    {
        decision.access = EAccess::Forbidden;
        decision.reason = fmt::format("{} is a viewer and may not send commands.", decision.identity->name);
    }
    else if (decision.identity->proof == EProof::Session && !Apps::IsFromOwnPage(request))
    {
        decision.access = EAccess::Forbidden;
        decision.reason = "A command with the cookie of a session needs the Origin of this address.";
    }
    return decision;
}

/// A token is more specific than a certificate: a browser shows its certificate without being asked again.
AccessPolicy::Decision AccessPolicy::Identify(
    const Apps::HttpSender& sender,
    const std::optional<OperatorToken::Hash>& sessionOrNull) const
{
    if (!_options.tokens.has_value() && !_options.certificates.has_value())
    {
        if (Apps::IsLoopback(sender.peer.host))
        {
            return {EAccess::Permitted, OperatorIdentity{EProof::Local, {}, EOperatorRole::Operator}, {}};
        }
        return {EAccess::Forbidden, std::nullopt, "Without operator.tokens_file only this machine is served."};
    }
    if (_options.tokens.has_value() && !sender.authorization.empty())
    {
        return IdentifyByToken(sender.authorization);
    }
    if (_options.tokens.has_value() && sessionOrNull.has_value())
    {
        if (Decision decision = IdentifyByHash(*sessionOrNull, EProof::Session); decision.access == EAccess::Permitted)
        {
            return decision;
        }
    }
    if (_options.certificates.has_value() && !sender.certificateName.empty())
    {
        return IdentifyByCertificate(sender.certificateName);
    }
    if (!_options.tokens.has_value())
    {
        return {EAccess::Unidentified, std::nullopt, "A client certificate is required."};
    }
    return {
        EAccess::Unidentified,
        std::nullopt,
        _options.certificates.has_value() ? "A token (Authorization: Bearer TOKEN) or a client certificate is required."
                                          : "A token is required (Authorization: Bearer TOKEN)."};
}

AccessPolicy::Decision AccessPolicy::IdentifyByToken(const std::string& authorization) const
{
    std::string_view text = authorization;
    const std::string_view scheme = Apps::TakeWord(text);
    const OperatorToken::Hash hash = HashToken(Apps::TakeWord(text));
    if (!IsBearer(scheme) || !Apps::TakeWord(text).empty())
    {
        return {EAccess::Unidentified, std::nullopt, "Expected Authorization: Bearer TOKEN."};
    }
    return IdentifyByHash(hash, EProof::Token);
}

AccessPolicy::Decision AccessPolicy::IdentifyByHash(const OperatorToken::Hash& hash, EProof proof) const
{
    assert(HasTokens());
    // The time depends neither on how much of a hash agrees nor on the line of the token.
    const OperatorToken* foundOrNull = nullptr;
    for (const OperatorToken& token : *_options.tokens)
    {
        if (CRYPTO_memcmp(token.hash.data(), hash.data(), hash.size()) == 0)
        {
            foundOrNull = &token;
        }
    }
    if (foundOrNull == nullptr)
    {
        return {EAccess::Unidentified, std::nullopt, "The token is unknown."};
    }
    return {EAccess::Permitted, OperatorIdentity{proof, foundOrNull->name, foundOrNull->role}, {}};
}

AccessPolicy::Decision AccessPolicy::IdentifyByCertificate(const std::string& name) const
{
    const auto found = _options.certificates->find(name);
    if (found == _options.certificates->end())
    {
        return {
            EAccess::Forbidden,
            std::nullopt,
            fmt::format("The certificate of {} has no role in operator.certificates.", Core::QuoteForError(name))};
    }
    return {EAccess::Permitted, OperatorIdentity{EProof::Certificate, name, found->second}, {}};
}

} // namespace ACS::Acsd
