#pragma once

#include "common/http/HttpMessage.hpp"
#include "operator/EOperatorRole.hpp"
#include "operator/OperatorToken.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Who sends a request.
struct OperatorIdentity
{
    enum class EProof : std::uint8_t
    {
        Local,      ///< None: any program on this machine.
        Token,      ///< The token of the name.
        Session,    ///< A session that a browser has opened with it.
        Certificate ///< A client certificate whose CN is the name.
    };

    EProof proof = EProof::Local;
    std::string name; ///< Empty for Local.
    EOperatorRole role = EOperatorRole::Viewer;

    bool operator==(const OperatorIdentity&) const = default;
};

/// "local", "token", "session" or "certificate".
[[nodiscard]] std::string_view GetText(OperatorIdentity::EProof proof);

/// Decides which requests of the operator interface are permitted. Viewers may read (GET, HEAD), operators may send every
/// request. Without tokens and certificates every program on this machine is an operator, and no other is served. Pure.
class AccessPolicy final
{
public:
    struct Options
    {
        std::optional<std::vector<OperatorToken>> tokens; ///< nullopt: tokens are not used.
        /// Roles by the CN of client certificates, whose CA the server has verified; nullopt: certificates are not used.
        std::optional<std::map<std::string, EOperatorRole>> certificates;
    };

    enum class EAccess : std::uint8_t
    {
        Permitted,
        Unidentified, ///< No valid token or certificate: 401.
        Forbidden     ///< Not for this client: 403.
    };

    struct Decision
    {
        EAccess access = EAccess::Unidentified;
        std::optional<OperatorIdentity> identity; ///< Set if permitted, and for a client whose role is not sufficient.
        std::string reason;                       ///< Why not, as a sentence.
    };

private:
    Options _options;

public:
    explicit AccessPolicy(Options options);

    /// Whether the request is served without identification: the files of the page, which contain no data.
    [[nodiscard]] static bool IsPublic(const Apps::HttpRequest& request);

    /// Whether clients can show a token.
    [[nodiscard]] bool HasTokens() const noexcept;

    /// With the token of the session of a browser. A browser sends its cookie by itself, so a command needs an Origin too.
    [[nodiscard]] Decision Decide(
        const Apps::HttpRequest& request,
        const std::optional<OperatorToken::Hash>& sessionOrNull = std::nullopt) const;

    /// Who sends the request, without regard to what it is.
    [[nodiscard]] Decision Identify(
        const Apps::HttpSender& sender,
        const std::optional<OperatorToken::Hash>& sessionOrNull) const;

    /// Whose token this is. HasTokens must be true.
    [[nodiscard]] Decision IdentifyByHash(const OperatorToken::Hash& hash, OperatorIdentity::EProof proof) const;

private:
    [[nodiscard]] Decision IdentifyByToken(const std::string& authorization) const;
    [[nodiscard]] Decision IdentifyByCertificate(const std::string& name) const;
};

} // namespace ACS::Acsd
