#pragma once

namespace ACS::Acsctl
{

// docs/reference/acsctl.md lists them.

constexpr int EXIT_DONE = 0;
constexpr int EXIT_REFUSED = 1;        ///< By acsd, or by the operator at the question.
constexpr int EXIT_BAD_INPUT = 2;      ///< Command line, configuration file, files of TLS and token.
constexpr int EXIT_NO_CONNECTION = 3;  ///< Also a time limit, and a lost connection.
constexpr int EXIT_NOT_AUTHORIZED = 4; ///< 401 and 403.
constexpr int EXIT_ATTENTION = 5;      ///< `why` and `status --check`.
constexpr int EXIT_BAD_ANSWER = 6;     ///< Not an answer of the operator API.
constexpr int EXIT_LOCAL_FAILURE = 7;  ///< A file could not be written.

} // namespace ACS::Acsctl
