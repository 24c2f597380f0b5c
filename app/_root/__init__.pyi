from . import app as app
from . import datasets as datasets
from . import semantics as semantics
from . import slam as slam
from .app.answers.run import Run as Run
from .app.answers.run import open_run as open_run
from .datasets.errors import RoomgraphError as RoomgraphError
from .datasets.readers.registry import open_sequence as open_sequence
from .datasets.sequence import Sequence as Sequence
from .semantics.graph.graph import SemanticGraph as SemanticGraph
from .semantics.recognition.model import PlaceModel as PlaceModel
from .semantics.recognition.model_files import load_model as load_model
from .slam.settings import SlamSettings as SlamSettings
from .slam.slam import Slam as Slam

__version__: str
