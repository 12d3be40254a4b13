#include "operator/AccessPolicy.hpp"

#include "common/config/Endpoint.hpp"
#include "common/config/WordReader.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>

#include <algorithm>
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

} // namespace

AccessPolicy::AccessPolicy(Options options)
    : _options(std::move(options))
{
}

AccessPolicy::Decision AccessPolicy::Decide(const Apps::HttpRequest& request) const
{
    Decision decision = Identify(request.sender);
    const bool bReads = request.method == "GET" || request.method == "HEAD";
    if (decision.access == EAccess::Permitted && !bReads && decision.identity->role == EOperatorRole::Viewer)
    {
        decision.access = EAccess::Forbidden;
        decision.reason = fmt::format("{} is a viewer and may not send commands.", decision.identity->name);
    }
    return decision;
}

/// A token is more specific than a certificate: a browser shows its certificate without being asked again.
AccessPolicy::Decision AccessPolicy::Identify(const Apps::HttpSender& sender) const
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
    return {EAccess::Permitted, OperatorIdentity{EProof::Token, foundOrNull->name, foundOrNull->role}, {}};
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
