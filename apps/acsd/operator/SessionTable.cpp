#include "operator/SessionTable.hpp"

#include <algorithm>

namespace ACS::Acsd
{

void SessionTable::Add(const Hash& secret, const Hash& token, Core::SteadyTime now)
{
    std::erase_if(_sessions, [now](const Session& session) { return now - session.openedAt >= LIFETIME; });
    const auto ofToken = std::ranges::count(_sessions, token, &Session::token);
    if (static_cast<std::size_t>(ofToken) >= MOST_PER_TOKEN)
    {
        _sessions.erase(std::ranges::find(_sessions, token, &Session::token));
    }
    if (_sessions.size() >= MOST_SESSIONS)
    {
        _sessions.erase(_sessions.begin());
    }
    _sessions.push_back({secret, token, now});
}

std::optional<SessionTable::Hash> SessionTable::FindTokenOrNull(const Hash& secret, Core::SteadyTime now) const
{
    const auto found = std::ranges::find(_sessions, secret, &Session::secret);
    if (found == _sessions.end() || now - found->openedAt >= LIFETIME)
    {
        return std::nullopt;
    }
    return found->token;
}

void SessionTable::Remove(const Hash& secret)
{
    std::erase_if(_sessions, [&secret](const Session& session) { return session.secret == secret; });
}

} // namespace ACS::Acsd
