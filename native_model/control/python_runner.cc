#include "native_model/control/python_runner.h"

namespace rotorub {

std::string_view python_runner() {
  return R"python(
import os, signal, struct, sys, _thread

CONNECTION = int(sys.argv[1])
FILE = "the law"
module = law = begun = commands = None
shape, length, state_size = [], 0, 0


def end_with_the_program():
    """Ends this process soon after rotorub has gone, also if the law never returns."""
    import select, time
    watch = select.poll()
    watch.register(CONNECTION, 0)
    watch.poll()
    time.sleep(1.0)
    os._exit(1)


def receive(count):
    parts = b""
    while len(parts) < count:
        part = os.read(CONNECTION, count - len(parts))
        if not part:
            return None
        parts += part
    return parts


def send(answer):
    answer = struct.pack("=I", len(answer)) + answer
    while answer:
        answer = answer[os.write(CONNECTION, answer):]


def function(name, arguments):
    found = getattr(module, name, None)
    if not callable(found):
        raise AttributeError(f"{FILE} has no function {name}({arguments})")
    return found


def forget_modules_in(folder):
    """What the law imports from its own folder is read again, so that every run begins alike."""
    for name, other in list(sys.modules.items()):
        if str(getattr(other, "__file__", None)).startswith(folder):
            del sys.modules[name]


def load(path):
    global module, FILE
    if FILE != path:
        sys.path[:1] = [os.path.dirname(path)] + [folder for folder in sys.path[:1] if folder]
    FILE = path
    forget_modules_in(os.path.join(os.path.dirname(path), ""))
    sys.argv = [path]
    module = sys.modules["rotorub_law"] = type(sys)("rotorub_law")
    module.__file__ = path
    with open(path, "rb") as file:
        text = file.read()
    exec(compile(text, path, "exec"), module.__dict__)
    function("create", "setup")
    function("step", "law, now, state")
    command = getattr(module, "command", "force")
    if command not in ("force", "current"):
        raise ValueError(f'{path}: command is {command!r}; choose from "force", "current"')
    return command.encode()


def create(setup, shape_of_now, commands_of_step):
    global law, begun, shape, length, commands, state_size
    commands = commands_of_step
    shape, length = [], 0
    for name, count in shape_of_now:
        numbers = count if isinstance(count, int) else 1
        shape.append((name, count, length, length + numbers))
        length += numbers
    law = module.create(setup)
    begun = True
    state_size = int(module.state_size(law)) if hasattr(module, "state_size") else 0
    if state_size < 0:
        raise ValueError(f"state_size() returns {state_size}; return 0 or more")
    state = bytearray(8 * state_size)
    if hasattr(module, "start"):
        with memoryview(state).cast("d") as view:
            module.start(law, view)
    return bytes(state)


def end():
    global module, law, begun
    if begun and hasattr(module, "destroy"):
        module.destroy(law)
    module = law = begun = None
    return b""


def step(request, now):
    values = struct.unpack_from(f"={length}d", request, 1)
    for name, count, first, last in shape:
        if count == "float":
            now[name] = values[first]
        elif count == "int":
            now[name] = int(values[first])
        else:
            now[name] = values[first:last]
    state = bytearray(request[1 + 8 * length:])
    with memoryview(state).cast("d") as view:
        told = module.step(law, now, view)
    try:
        told = [float(value) for value in told]
    except TypeError:
        raise TypeError(f"step() returns {type(told).__name__}; return {expected()}") from None
    if len(told) != commands:
        raise TypeError(f"step() returns {len(told)} numbers; return {expected()}")
    return struct.pack(f"={commands}d", *told) + state


def expected():
    return "two numbers, ux and uy" if commands == 2 else f"{commands} numbers, one current for each port"


def words_of(error, given, name):
    """The exception, the innermost places of the law that it came through, and what helps."""
    text = f"{type(error).__name__}: {error}"
    if isinstance(error, SyntaxError):
        return f"{type(error).__name__}: {error.msg} ({error.filename}:{error.lineno})"
    frames, trace = [], error.__traceback__
    while trace is not None:
        code = trace.tb_frame.f_code
        if code.co_filename != "<string>":
            frames.append((code.co_name, code.co_filename, trace.tb_lineno))
        trace = trace.tb_next
    import linecache
    for place, file, line in frames[-3:]:
        text += f", in {place} ({file}:{line})"
    if frames:
        source = linecache.getline(*frames[-1][1:]).strip()
        text += f": `{source}`" if source else ""
    if isinstance(error, KeyError) and error.args and given is not None and error.args[0] not in given:
        text += f"; {name} has the keys {', '.join(given)}"
    if isinstance(error, ModuleNotFoundError):
        text += f"; the law runs in {sys.executable}, and ROTORUB_PYTHON selects another Python"
    return text


def answer_to(request):
    kind, given, name = request[:1], None, ""
    try:
        if kind == b"S":
            given, name = {}, "now"
            return b"\0" + step(request, given)
        if kind == b"E":
            return b"\0" + end()
        if kind == b"L":
            return b"\0" + load(os.fsdecode(request[1:]))
        import json
        asked = json.loads(request[1:].decode("utf-8", "surrogateescape"))
        given, name = asked["setup"], "setup"
        return b"\0" + create(given, asked["shape"], asked["commands"])
    except BaseException as error:
        return b"\1" + words_of(error, given, name).encode("utf-8", "backslashreplace")


sys.dont_write_bytecode = True
signal.signal(signal.SIGINT, signal.SIG_IGN)  # rotorub ends the run
_thread.start_new_thread(end_with_the_program, ())
while True:
    head = receive(4)
    request = head and receive(struct.unpack("=I", head)[0])
    if not request:
        break
    send(answer_to(request))
)python";
}

}  // namespace rotorub
