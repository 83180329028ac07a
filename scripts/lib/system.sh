# shellcheck shell=bash
# What a machine must have besides the Rust toolchain, how to see that it is missing, and how to get it.
# Sourced by scripts/run and scripts/test. Everything here speaks on stderr: stdout belongs to the program.

say() {
    printf 'scripts/%s: %s\n' "${0##*/}" "$*" >&2
}

die() {
    say "$@"
    exit 1
}

on_linux() {
    [ "$(uname -s)" = Linux ]
}

# macOS and Windows always have a display; Linux has one when a session names it.
have_display() {
    ! on_linux || [ -n "${DISPLAY:-}" ] || [ -n "${WAYLAND_DISPLAY:-}" ]
}

# Finds cargo, also where a fresh rustup has not reached this shell's PATH yet.
require_cargo() {
    command -v cargo >/dev/null && return
    PATH="${CARGO_HOME:-$HOME/.cargo}/bin:$PATH"
    command -v cargo >/dev/null || die "cargo was not found: install the Rust toolchain from https://rustup.rs and run this again"
}

# ---- Needs: each function calls `missing` for what it cannot find. Only Linux machines are looked at. ----

missing_packages=() # Debian's names
missing_reasons=()  # a line each, for people

missing() { # PACKAGES REASON
    local package
    for package in $1; do
        missing_packages+=("$package")
    done
    missing_reasons+=("$2")
}

# Rust links with the system's C compiler, and two dependencies compile a few lines of C.
need_c_compiler() {
    local program
    program=$(mktemp)
    echo 'int main(void) { return 0; }' | cc -x c -o "$program" - 2>/dev/null ||
        missing "gcc libc6-dev" "a C compiler that can link a program"
    rm -f "$program"
}

need_library() { # SONAME PACKAGE PURPOSE
    # Not in everyone's PATH. The whole output is read, since pipefail would take grep's early exit for a failure.
    PATH="$PATH:/sbin:/usr/sbin" ldconfig -p | grep -F "$1 " >/dev/null || missing "$2" "$1, $3"
}

# True where a Vulkan driver whose manifest has this name (a glob) is installed.
have_vulkan_driver() {
    [ -z "${VK_DRIVER_FILES:-}${VK_ICD_FILENAMES:-}" ] || return 0
    local folder folders manifest
    IFS=: read -ra folders <<<"${XDG_DATA_HOME:-$HOME/.local/share}:${XDG_DATA_DIRS:-/usr/local/share:/usr/share}:/etc"
    for folder in "${folders[@]}"; do
        for manifest in "$folder"/vulkan/icd.d/$1; do
            [ ! -e "$manifest" ] || return 0
        done
    done
    return 1
}

need_vulkan() {
    need_library libvulkan.so.1 libvulkan1 "the Vulkan loader"
    have_vulkan_driver '*.json' || missing mesa-vulkan-drivers "a Vulkan driver"
}

# The software driver runs anywhere, also where a driver is installed whose graphics card is not.
need_software_vulkan() {
    need_library libvulkan.so.1 libvulkan1 "the Vulkan loader"
    have_vulkan_driver 'lvp_icd*.json' || missing mesa-vulkan-drivers "the software Vulkan driver (lavapipe)"
}

# The window opens these while it runs, so no build fails without them.
need_x11_client() {
    need_library libX11.so.6 libx11-6 "to open a window under X"
    need_library libX11-xcb.so.1 libx11-xcb1 "to open a window under X"
    need_library libXcursor.so.1 libxcursor1 "the mouse pointer under X"
    need_library libXi.so.6 libxi6 "mouse and touch input under X"
    need_library libxkbcommon-x11.so.0 libxkbcommon-x11-0 "the keyboard under X"
}

need_wayland_client() {
    need_library libwayland-client.so.0 libwayland-client0 "to open a window under Wayland"
    need_library libxkbcommon.so.0 libxkbcommon0 "the keyboard under Wayland"
}

# The libraries of the session that is there: one of them may well be absent on a machine that only has the other.
need_window() {
    if [ -n "${WAYLAND_DISPLAY:-}" ]; then need_wayland_client; else need_x11_client; fi
}

need_virtual_display() {
    command -v Xvfb >/dev/null || missing xvfb "Xvfb, a display without a screen"
}

# ---- Getting it ----

# require_system NEED…: looks for every need, installs what is missing and looks again.
require_system() {
    on_linux || return 0
    look_for "$@"
    [ ${#missing_packages[@]} -gt 0 ] || return 0
    say "this machine lacks:"
    printf '  %s\n' "${missing_reasons[@]}" >&2
    if ! command -v apt-get >/dev/null; then
        # Other systems keep libraries in places of their own: what was not found may be there all the same.
        say "going on without; if it fails, install what your system calls these Debian packages: ${missing_packages[*]}"
        return 0
    fi
    install_missing
    look_for "$@"
    [ ${#missing_packages[@]} -eq 0 ] || die "still not found after apt-get installed it: ${missing_reasons[*]}"
}

look_for() {
    missing_packages=()
    missing_reasons=()
    local need
    for need in "$@"; do
        "$need"
    done
}

install_missing() {
    local as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! sudo -n true 2>/dev/null; then
            die "install it, then run this again:
  sudo apt-get update && sudo apt-get install --no-install-recommends ${missing_packages[*]}"
        fi
        as_root=(sudo -n)
    fi
    as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0)
    say "installing ${missing_packages[*]}"
    # A third-party source that fails to update need not stop the installation; apt-get names it.
    "${as_root[@]}" update >&2 || say "apt-get update failed; trying with the package lists that are here"
    "${as_root[@]}" install --yes --no-install-recommends "${missing_packages[@]}" >&2 ||
        die "apt-get could not install ${missing_packages[*]}"
}
