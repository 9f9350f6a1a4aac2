#pragma once

#include <cstdlib>
#include <string>

namespace mis {

/// throw Error(what). In a host that is built without exceptions it ends the program: what the
/// docstring says is thrown is then a precondition.
template <class Error> [[noreturn]] void raise(const std::string& what)
{
#if defined(__cpp_exceptions)
    throw Error(what);
#else
    static_cast<void>(what);
    std::abort();
#endif
}

}  // namespace mis
